#version 460
#extension GL_GOOGLE_include_directive : require

// One MIP level of an environment's cube from the level above it.

#include "lib/light/environment_mean.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target;

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(position, imageSize(target))))
        return;
    ivec2 corner = 2 * position.xy;
    vec4 values[4];
    for (int i = 0; i < 4; ++i)
        values[i] = texelFetch(source, ivec3(corner + ivec2(i & 1, i >> 1), position.z), 0);
    imageStore(target, position, environment_mean(values, corner, textureSize(source, 0).x));
}
