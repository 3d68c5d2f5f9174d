#version 460
#extension GL_GOOGLE_include_directive : require

// The numbers of which each patch's T is a quotient (interface/displacement/wu.h): the light that
// S makes of the coarse relief's nearest to the patch's, over pairs of directions by their cosines.
// A group a patch.
//
// Wu et al., 2019, Eq. 22. Printed there: the mean of ratios, to be divided by the map's.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"

const uint THREADS = 128u;
layout(local_size_x = THREADS) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) readonly buffer direct_block { float direct[]; };
layout(set = 0, binding = 5, std430) readonly buffer indirect_block { float indirect[]; };
layout(set = 0, binding = 6, std430) readonly buffer low_pair_block { float low_pairs[]; };
layout(set = 0, binding = 9, std430) readonly buffer cell_pair_block { float cell_pairs[]; };
layout(set = 0, binding = 7, std430) readonly buffer ratio_block { vec2 ratios[]; };
// Two for each patch: numerator, denominator.
layout(set = 0, binding = 8, std430) writeonly buffer patch_block { vec4 quotients[]; };

const float PRINTED = 1e-5, LARGEST_RATIO = 4.0;

shared vec4 above[THREADS], below[THREADS];

void main() {
    uint directions = wu.angular * wu.angular, pairs = directions * directions;
    uint own = gl_LocalInvocationIndex, patch_index = gl_WorkGroupID.x;
    vec4 numerator = vec4(0.0), denominator = vec4(0.0);
    for (uint i = own; i < pairs; i += THREADS) {
        float weight = direction_of_index(i / directions, wu.angular).z *
                       direction_of_index(i % directions, wu.angular).z;
        uint place = patch_index * pairs + i;
        vec2 light = vec2(direct[place], indirect[place]);
        vec2 low = vec2(low_pairs[place], cell_pairs[place]);
        if (is_printed(WU_PRINTED_RATIO)) {
            numerator.xy += weight * min(light / (low + PRINTED), LARGEST_RATIO);
            continue;
        }
        vec2 scaled = ratios[wu.levels[stage.level].first_pair + i] * low;
        numerator.xyz += weight * vec3(light.x * scaled.x,
                                       light.x * scaled.y + light.y * scaled.x, light.y * scaled.y);
        denominator.xyz += weight * vec3(scaled.x * scaled.x, 2.0 * scaled.x * scaled.y,
                                         scaled.y * scaled.y);
    }
    above[own] = numerator;
    below[own] = denominator;
    barrier();
    if (own != 0u)
        return;
    for (uint i = 1u; i < THREADS; ++i) {
        numerator += above[i];
        denominator += below[i];
    }
    quotients[2u * patch_index] = numerator;
    quotients[2u * patch_index + 1u] = denominator;
}
