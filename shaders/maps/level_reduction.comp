#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// One MIP level of an array of linear maps from the level above it, at any size; with SEEN_TILES,
// of its listed tiles alone. What is not finite in an image of the host's counts as 0.

#include "lib/map/box_reduction.glsl"
#include "lib/number/finite.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef SEEN_TILES
layout(push_constant) uniform constants_block { uint level; };
#else
const uint level = 0u;
#endif
layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target;

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    if (!find_target_texel(level, imageSize(target).xy, position.xy))
        return;
    ivec2 size = textureSize(source, 0).xy;
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < box_taps(size.y); ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < box_taps(size.x); ++x) {
            ivec3 texel = ivec3(2 * position.xy + ivec2(x, y), position.z);
            row += column_weights[x] * finite_or_zero(texelFetch(source, texel, 0));
        }
        sum += row_weights[y] * row;
    }
    imageStore(target, position, sum);
}
