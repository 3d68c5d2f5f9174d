#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require

// Components of a level of few texels, searched for as those of the whole map are, where these are
// closer to a texel's lobes than the ones from its parent's: a map may hold several materials in
// different places, each of which deserves all components there. A group for each texel.

#include "filters/mixture/component_search.glsl"
#include "filters/mixture/parents.glsl"

layout(set = 0, binding = 16) uniform writeonly image2DArray component_map;

const uint CELLS = 32; // along each side

// Of the squared lobes, that found components must be better than the parent's: less changes
// neighbours' likeness for nothing.
const float LEAST_IMPROVEMENT = 0.005;

shared mixture_component parents[BINS];

// In the order in which they are most like the parent's, so that interpolation between texels
// blends like with like: pairs change places while less would be lost by merging each component
// with the parent's. One thread.
void order_components(mixture_units units) {
    [[dont_unroll]]
    for (uint round = 0u; round < BINS; ++round) {
        [[dont_unroll]]
        for (uint i = 0u; i < BINS; ++i) {
            [[dont_unroll]]
            for (uint j = i + 1u; j < BINS; ++j) {
                float loss = loss_of_merger(parents[i], kept[i], units) +
                             loss_of_merger(parents[j], kept[j], units);
                float exchanged = loss_of_merger(parents[i], kept[j], units) +
                                  loss_of_merger(parents[j], kept[i], units);
                if (exchanged < loss) {
                    mixture_component other = kept[i];
                    kept[i] = kept[j];
                    kept[j] = other;
                }
            }
        }
    }
}

void main() {
    uvec2 texel = gl_WorkGroupID.xy, size = uvec2(imageSize(component_map).xy);
    mixture_units units = units_of_map();
    if (thread() < BINS) {
        parents[thread()] = parent_component(parent_of(texel, size), int(thread()));
        components[thread()] = kept[thread()] = parents[thread()];
    }
    uvec2 low = box_low(texel, size);
    sampled_area area = make_area(low, box_high(texel, size) - low, CELLS);
    float least_error = 1e38;
    for (uint i = 0u; i <= STARTS; ++i) {
        keep_better(area, i == 0u ? GIVEN : i - 1u, units, least_error);
        if (i == 0u)
            least_error -= LEAST_IMPROVEMENT * abs(least_error);
    }
    if (thread() == 0u)
        order_components(units);
    barrier();
    if (thread() < BINS) {
        int j = int(thread());
        imageStore(component_map, ivec3(texel, 2 * j), vec4(kept[j].part, kept[j].mean));
        imageStore(component_map, ivec3(texel, 2 * j + 1), kept[j].covariance);
    }
}
