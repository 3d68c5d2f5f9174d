#version 460
#extension GL_GOOGLE_include_directive : require

// Three MIP levels of an environment's cube at once through shared memory, where the source's width
// is a multiple of eight: every source texel is read once, every target texel written once.

#include "lib/light/environment_mean.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target_1;
layout(set = 0, binding = 2) uniform writeonly image2DArray target_2;
layout(set = 0, binding = 3) uniform writeonly image2DArray target_3;

shared vec4 tile[8][8];

vec4 mean_of_tile(ivec2 child, ivec2 corner, int size) {
    vec4 values[4] = {tile[child.y][child.x], tile[child.y][child.x + 1],
                      tile[child.y + 1][child.x], tile[child.y + 1][child.x + 1]};
    return environment_mean(values, corner, size);
}

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    ivec2 group = ivec2(gl_WorkGroupID.xy);
    int face = int(gl_WorkGroupID.z), size = textureSize(source, 0).x;

    // Level 1: an 8x8 block per group, four source texels per invocation.
    ivec2 position = 8 * group + local;
    vec4 mean = vec4(0.0);
    if (all(lessThan(position, imageSize(target_1).xy))) {
        vec4 values[4];
        for (int i = 0; i < 4; ++i)
            values[i] = texelFetch(source, ivec3(2 * position + ivec2(i & 1, i >> 1), face), 0);
        mean = environment_mean(values, 2 * position, size);
        imageStore(target_1, ivec3(position, face), mean);
    }
    tile[local.y][local.x] = mean;
    barrier();

    // Level 2: 4x4. The size is a multiple of eight, so a block has all of its source or none.
    bool second = all(lessThan(local, ivec2(4)));
    ivec2 child = 2 * local;
    if (second) {
        position = 4 * group + local;
        mean = mean_of_tile(child, 2 * position, size / 2);
        if (all(lessThan(position, imageSize(target_2).xy)))
            imageStore(target_2, ivec3(position, face), mean);
    }
    barrier();
    if (second)
        tile[local.y][local.x] = mean;
    barrier();

    // Level 3: 2x2.
    if (all(lessThan(local, ivec2(2)))) {
        position = 2 * group + local;
        mean = mean_of_tile(child, 2 * position, size / 4);
        if (all(lessThan(position, imageSize(target_3).xy)))
            imageStore(target_3, ivec3(position, face), mean);
    }
}
