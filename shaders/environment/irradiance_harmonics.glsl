#ifndef IRRADIANCE_HARMONICS_GLSL
#define IRRADIANCE_HARMONICS_GLSL

#include "interface/environment/irradiance_harmonics.h"

// Sums of harmonics over the invocations of a group by repeated halving: always in the same order,
// and with only log2(64) roundings.

layout(local_size_x = HARMONICS_GROUP_SIZE) in;

shared vec4 sums[HARMONICS][HARMONICS_GROUP_SIZE];

// Leaves the group's sum in the first invocation's values. All invocations must call it.
void add_up_group(inout vec4 own[HARMONICS]) {
    uint local = gl_LocalInvocationID.x;
    for (int i = 0; i < HARMONICS; ++i)
        sums[i][local] = own[i];
    for (uint half_size = HARMONICS_GROUP_SIZE / 2; half_size > 0; half_size /= 2) {
        barrier();
        if (local < half_size) {
            for (int i = 0; i < HARMONICS; ++i)
                sums[i][local] += sums[i][local + half_size];
        }
    }
    for (int i = 0; i < HARMONICS; ++i)
        own[i] = sums[i][local];
}

#endif
