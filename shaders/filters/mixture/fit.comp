#version 460
#extension GL_GOOGLE_include_directive : require

// Components of a level whose texels cover many of the maps': a group for each texel, over a sample
// of those.

#include "filters/mixture/group_fit.glsl"
#include "filters/mixture/parents.glsl"

layout(set = 0, binding = 16) uniform writeonly image2DArray component_map;

const uint CELLS = 128; // along each side

void main() {
    uvec2 texel = gl_WorkGroupID.xy, size = uvec2(imageSize(component_map).xy);
    if (thread() < BINS)
        components[thread()] = parent_component(parent_of(texel, size), int(thread()));
    barrier();
    uvec2 low = box_low(texel, size);
    sampled_area area = make_area(low, box_high(texel, size) - low, CELLS);
    mixture_units units = units_of_map();
    uint rounds = 0;
    if (START == MIXTURE_START_K_MEANS) {
        for (int j = 0; j < BINS; ++j)
            add_component(area, j, K_MEANS, units);
        rounds = ROUNDS_OF_K_MEANS;
    }
    for (uint step = 0; step < rounds + constants.steps; ++step)
        take_step(area, step < rounds, units);
    if (thread() < BINS) {
        int j = int(thread());
        imageStore(component_map, ivec3(texel, 2 * j),
                   vec4(components[j].part, components[j].mean));
        imageStore(component_map, ivec3(texel, 2 * j + 1), components[j].covariance);
    }
}
