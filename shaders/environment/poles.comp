#version 460
#extension GL_GOOGLE_include_directive : require

// Builds the texels of an environment's cube around the poles of a latitude and longitude image, as
// cube.comp builds the others, but a group for each texel. Rows are short there, and each of the
// many points of a texel reads a part of a row's columns: a loop for them all is long for one
// invocation, and longer than lavapipe lets it be, which silently ends a shader's loops after 65535
// iterations.

#include "environment/cube.glsl"

layout(local_size_x = ENVIRONMENT_POLAR_GROUP_SIZE) in;

shared vec4 sums[ENVIRONMENT_POLAR_GROUP_SIZE];

void main() {
    int local = int(gl_LocalInvocationIndex), width = int(constants.polar_width);
    int index = int(gl_WorkGroupID.x);
    ivec3 texel = ivec3(index % width, index / width % width, 2 + index / (width * width));
    texel.xy += (int(constants.size) - width) / 2;
    vec3 base;
    sums[local] = sum_of_points(texel, local, ENVIRONMENT_POLAR_GROUP_SIZE, base);
    for (int half_size = ENVIRONMENT_POLAR_GROUP_SIZE / 2; half_size > 0; half_size /= 2) {
        barrier();
        if (local < half_size)
            sums[local] += sums[local + half_size];
    }
    if (local == 0)
        store_mean(texel, base, sums[0]);
}
