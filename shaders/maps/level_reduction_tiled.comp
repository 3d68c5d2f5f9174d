#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// Three MIP levels at once through shared memory, where the source's width and height are
// multiples of eight: every source texel is read once, every target texel written once. With
// SEEN_TILES, what is made from the listed tiles of the first of them.

#include "lib/number/finite.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#ifdef SEEN_TILES
layout(push_constant) uniform constants_block { uint level; }; // the first that is made
#else
const uint level = 0u;
#endif
layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target_1;
layout(set = 0, binding = 2) uniform writeonly image2DArray target_2;
layout(set = 0, binding = 3) uniform writeonly image2DArray target_3;

shared vec4 tile[8][8];

// What is not finite in an image of the host's counts as 0.
vec4 source_at(ivec3 position) {
    return finite_or_zero(texelFetch(source, position, 0));
}

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    ivec2 group;
    if (!find_target_square(level, group))
        return;
    group /= 8;
    int layer = int(gl_WorkGroupID.z);

    // Level 1: an 8x8 block per group, four source texels per invocation.
    ivec2 position = 8 * group + local;
    bool inside = all(lessThan(position, imageSize(target_1).xy));
    vec4 mean = vec4(0.0);
    if (inside) {
        ivec3 corner = ivec3(2 * position, layer);
        mean = 0.25 * ((source_at(corner) + source_at(corner + ivec3(1, 0, 0))) +
                       (source_at(corner + ivec3(0, 1, 0)) + source_at(corner + ivec3(1, 1, 0))));
        imageStore(target_1, ivec3(position, layer), mean);
    }
    tile[local.y][local.x] = mean;
    barrier();

    // Level 2: 4x4. The size is a multiple of eight, so a block has all of its source or none.
    bool second = all(lessThan(local, ivec2(4)));
    ivec2 child = 2 * local;
    if (second) {
        mean = 0.25 * ((tile[child.y][child.x] + tile[child.y][child.x + 1]) +
                       (tile[child.y + 1][child.x] + tile[child.y + 1][child.x + 1]));
        position = 4 * group + local;
        if (all(lessThan(position, imageSize(target_2).xy)))
            imageStore(target_2, ivec3(position, layer), mean);
    }
    barrier();
    if (second)
        tile[local.y][local.x] = mean;
    barrier();

    // Level 3: 2x2.
    if (all(lessThan(local, ivec2(2)))) {
        mean = 0.25 * ((tile[child.y][child.x] + tile[child.y][child.x + 1]) +
                       (tile[child.y + 1][child.x] + tile[child.y + 1][child.x + 1]));
        position = 2 * group + local;
        if (all(lessThan(position, imageSize(target_3).xy)))
            imageStore(target_3, ivec3(position, layer), mean);
    }
}
