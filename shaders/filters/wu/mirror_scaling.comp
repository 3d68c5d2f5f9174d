#version 460
#extension GL_GOOGLE_include_directive : require

// S and T of what microfacets mirror (interface/displacement/wu.h), as scaling_table and
// scaling_patches make those of diffuse light. One group.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"

const uint THREADS = 128u;
layout(local_size_x = THREADS) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) readonly buffer mirror_pair_block { vec2 pairs[]; };
layout(set = 0, binding = 5, std430) buffer whole_block {
    vec4 energy;
    float mirrors[];
};

// Added to both means, as a part of the table's mean; printed: to the divisor.
const float PART_OF_MEAN = 0.01, PRINTED = 1e-5;
const float LARGEST_RATIO = 4.0;

shared vec2 partial[THREADS];

vec2 sum_of_all(vec2 own) {
    barrier();
    partial[gl_LocalInvocationIndex] = own;
    barrier();
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < THREADS; ++i)
        sum += partial[i];
    return sum;
}

float printed_ratio(vec2 light) {
    return min(light.x / (light.y + PRINTED), LARGEST_RATIO);
}

float scaling_of_pair(uint pair, uint count, uint patches, float added) {
    vec2 sum = vec2(0.0);
    float ratios = 0.0;
    for (uint i = 0u; i < patches; ++i) {
        sum += pairs[i * count + pair];
        ratios += printed_ratio(pairs[i * count + pair]);
    }
    sum /= float(patches);
    return is_printed(WU_PRINTED_RATIO) ? ratios / float(patches)
                            : min((sum.x + added) / (sum.y + added), LARGEST_RATIO);
}

// Numerator and denominator of a patch's T.
vec2 scaling_of_patch(uint patch_index, uint first, uint count) {
    vec2 sum = vec2(0.0);
    for (uint i = gl_LocalInvocationIndex; i < count; i += THREADS) {
        float weight = direction_of_index(i / (wu.angular * wu.angular), wu.angular).z *
                       direction_of_index(i % (wu.angular * wu.angular), wu.angular).z;
        vec2 light = pairs[patch_index * count + i];
        float scaled = mirrors[first + i] * light.y;
        sum += weight * (is_printed(WU_PRINTED_RATIO)
                             ? vec2(printed_ratio(light), mirrors[first + i])
                             : vec2(light.x * scaled, scaled * scaled));
    }
    return sum_of_all(sum);
}

void main() {
    uint directions = wu.angular * wu.angular, count = directions * directions;
    uint patches = wu.patches * wu.patches, first = stage.level * mirror_stride();
    vec2 own = vec2(0.0);
    for (uint i = gl_LocalInvocationIndex; i < patches * count; i += THREADS)
        own += pairs[i];
    float added = max(PART_OF_MEAN * sum_of_all(own).y / float(patches * count), 1e-9);
    for (uint i = gl_LocalInvocationIndex; i < count; i += THREADS)
        mirrors[first + i] = scaling_of_pair(i, count, patches, added);
    memoryBarrierBuffer();
    for (uint i = 0u; i < patches; ++i) {
        vec2 quotient = scaling_of_patch(i, first, count);
        if (gl_LocalInvocationIndex == 0u) {
            mirrors[first + count + 2u * i] = quotient.x;
            mirrors[first + count + 2u * i + 1u] = quotient.y;
        }
    }
}
