#version 460
#extension GL_GOOGLE_include_directive : require

// The table S of a level: what the relief sends from one direction to another, over what the coarse
// relief's lobes do, at once and by way of other facets. One group.
//
// Wu et al., 2019, Eq. 20 and 24. Printed there: the mean over patches of ratios. Otherwise: the
// ratio of means, which conserves energy.

#include "filters/wu/cells.glsl"

const uint THREADS = 128u;
layout(local_size_x = THREADS) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) readonly buffer direct_block { float direct[]; };
layout(set = 0, binding = 5, std430) readonly buffer indirect_block { float indirect[]; };
layout(set = 0, binding = 6, std430) readonly buffer low_pair_block { float low_pairs[]; };
layout(set = 0, binding = 9, std430) readonly buffer cell_pair_block { float cell_pairs[]; };
layout(set = 0, binding = 7, std430) writeonly buffer ratio_block { vec2 ratios[]; };

// Added to both means, as a part of the table's mean; printed: to the divisor.
const float PART_OF_MEAN = 0.01, PRINTED = 1e-5;
const float LARGEST_RATIO = 4.0;

shared vec2 partial[THREADS];

// Of white facets, by the lobes: light at once, and what light between facets is scaled from.
vec2 light_of_cells(uint place) {
    return vec2(low_pairs[place], cell_pairs[place]);
}

vec2 mean_of_table(uint count) {
    vec2 sum = vec2(0.0);
    for (uint i = gl_LocalInvocationIndex; i < count; i += THREADS)
        sum += light_of_cells(i);
    partial[gl_LocalInvocationIndex] = sum;
    barrier();
    sum = vec2(0.0);
    for (uint i = 0u; i < THREADS; ++i)
        sum += partial[i];
    return sum / float(count);
}

vec2 ratio_of_means(uint pair, uint pairs, uint patches, vec2 added) {
    vec2 above = vec2(0.0), below = vec2(0.0);
    for (uint i = 0u; i < patches; ++i) {
        above += vec2(direct[i * pairs + pair], indirect[i * pairs + pair]);
        below += light_of_cells(i * pairs + pair);
    }
    return min((above / float(patches) + vec2(added.x, 0.0)) / (below / float(patches) + added),
               LARGEST_RATIO);
}

vec2 mean_of_ratios(uint pair, uint pairs, uint patches) {
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < patches; ++i)
        sum += min(vec2(direct[i * pairs + pair], indirect[i * pairs + pair]) /
                       (light_of_cells(i * pairs + pair) + PRINTED),
                   LARGEST_RATIO);
    return sum / float(patches);
}

void main() {
    uint directions = wu.angular * wu.angular, pairs = directions * directions;
    uint patches = wu.patches * wu.patches;
    vec2 added = max(PART_OF_MEAN * mean_of_table(pairs * patches), 1e-9);
    for (uint i = gl_LocalInvocationIndex; i < pairs; i += THREADS)
        ratios[wu.levels[stage.level].first_pair + i] =
            is_printed(WU_PRINTED_RATIO) ? mean_of_ratios(i, pairs, patches)
                             : ratio_of_means(i, pairs, patches, added);
}
