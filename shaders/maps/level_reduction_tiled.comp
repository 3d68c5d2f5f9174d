#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// Three MIP levels at once, where the source's width and height are multiples of eight: every
// source texel is read once, every target texel written once. With SEEN_TILES, what is made from
// the listed tiles of the first of them.
//
// A workgroup has 8x8 texels of the first level, four for each invocation, which has the second
// level in registers: on lavapipe shared memory and barriers take longer than the means.

#include "lib/number/finite.glsl"
#include "maps/target_texel.glsl"

const int THREADS = 4; // each way

layout(local_size_x = THREADS, local_size_y = THREADS) in;

#ifdef SEEN_TILES
layout(push_constant) uniform constants_block { uint level; }; // the first that is made
#else
const uint level = 0u;
#endif
layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target_1;
layout(set = 0, binding = 2) uniform writeonly image2DArray target_2;
layout(set = 0, binding = 3) uniform writeonly image2DArray target_3;

shared vec4 tile[THREADS][THREADS];

// What is not finite in an image of the host's counts as 0.
vec4 source_at(ivec3 position) {
    return finite_or_zero(texelFetch(source, position, 0));
}

vec4 mean_of_source(ivec3 position) {
    ivec3 corner = ivec3(2 * position.xy, position.z);
    return 0.25 * ((source_at(corner) + source_at(corner + ivec3(1, 0, 0))) +
                   (source_at(corner + ivec3(0, 1, 0)) + source_at(corner + ivec3(1, 1, 0))));
}

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    ivec2 corner;
    if (!find_target_square(level, corner))
        return;
    int layer = int(gl_WorkGroupID.z);

    // The first level's size is a multiple of four, so that all four are inside or none.
    ivec3 first = ivec3(corner + 2 * local, layer);
    vec4 mean = vec4(0.0);
    if (all(lessThan(first.xy, imageSize(target_1).xy))) {
        vec4 texels[4];
        for (int i = 0; i < 4; ++i) {
            ivec3 position = first + ivec3(i & 1, i >> 1, 0);
            texels[i] = mean_of_source(position);
            imageStore(target_1, position, texels[i]);
        }
        mean = 0.25 * ((texels[0] + texels[1]) + (texels[2] + texels[3]));
        imageStore(target_2, ivec3(first.xy / 2, layer), mean);
    }
    tile[local.y][local.x] = mean;
    barrier();

    ivec2 child = 2 * local;
    ivec2 position = corner / 4 + local;
    if (all(lessThan(local, ivec2(2))) && all(lessThan(position, imageSize(target_3).xy))) {
        mean = 0.25 * ((tile[child.y][child.x] + tile[child.y][child.x + 1]) +
                       (tile[child.y + 1][child.x] + tile[child.y + 1][child.x + 1]));
        imageStore(target_3, ivec3(position, layer), mean);
    }
}
