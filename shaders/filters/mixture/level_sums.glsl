#ifndef LEVEL_SUMS_GLSL
#define LEVEL_SUMS_GLSL

// Steps of expectation maximisation over all lobes under a texel of a level, and what components
// have of these.

#include "filters/mixture/parents.glsl"

layout(constant_id = SPECIALISE_MIXTURE_PLANE) const uint PLANE = MIXTURE_PLANE_LAMBERT;

const bool PROJECTED = PLANE == MIXTURE_PLANE_PROJECTED;

struct level_box {
    uvec2 texel, size; // of the level
    uvec2 low, high;
};

// What the components have of the lobes under a texel.
struct level_sums {
    component_sums moments[MIXTURE_MAXIMUM_COMPONENTS]; // d from the components' means
    vec2 widths[MIXTURE_MAXIMUM_COMPONENTS];            // m / sqrt(v), m v
    vec4 colour[MIXTURE_MAXIMUM_COMPONENTS];
    vec4 diffuse; // and how much all lobes count
};

float weight_of(level_box box, uvec2 at) {
    return box_weight(at.x, box.texel.x, box.size.x, constants.width) *
           box_weight(at.y, box.texel.y, box.size.y, constants.height);
}

// Tan et al. 2005, section 4.1: the mean between a component's samples and the like components of
// its neighbours, each of which counts as `prior` samples times its part. Of the neighbours these
// are the parent and the four beside it, because texels of one level are fitted at the same time.
vec2 drawn_to_neighbours(level_box box, int index, mixture_component own) {
    const ivec2 offsets[5] =
        ivec2[](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    ivec2 parent = parent_of(box.texel, box.size), end = textureSize(parent_map, 0).xy - 1;
    float samples = own.part * float(constants.width * constants.height) /
                    float(box.size.x * box.size.y);
    vec3 sum = samples * vec3(own.mean.xy, 1.0);
    for (int i = 0; i < 5; ++i) {
        mixture_component other =
            parent_component(clamp(parent + offsets[i], ivec2(0), end), index);
        sum += constants.prior * other.part * vec3(other.mean.xy, 1.0);
    }
    return sum.xy / sum.z;
}

void add_lobe(inout level_sums sums, ivec2 texel, int i, float weight, bool nearest,
              mixture_units units, component_density densities[MIXTURE_MAXIMUM_COMPONENTS]) {
    mixture_sample lobe = read_sample(texel, i, units);
    float shares[MIXTURE_MAXIMUM_COMPONENTS];
    share_out(densities, lobe, nearest, units, shares);
    vec4 colour = vec4(0.0);
    if (BIN_COLOUR)
        colour = texelFetch(sample_map, ivec3(texel, LAYERS * i + 2), 0);
    for (int j = 0; j < BINS; ++j) {
        float mass = shares[j] * weight * lobe.mass;
        add_share(sums.moments[j], densities[j].mean, lobe, mass);
        sums.widths[j] += mass * lobe.widths;
        if (BIN_COLOUR)
            sums.colour[j] += mass * colour;
    }
}

// Shared out by densities or, `nearest`, by distance.
level_sums sum_lobes(level_box box, bool nearest, mixture_units units,
                     mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    component_density densities[MIXTURE_MAXIMUM_COMPONENTS];
    level_sums sums;
    sums.diffuse = vec4(0.0);
    for (int j = 0; j < BINS; ++j) {
        densities[j] = density_of(components[j]);
        sums.moments[j] = component_sums(vec4(0.0), vec4(0.0));
        sums.widths[j] = vec2(0.0);
        sums.colour[j] = vec4(0.0);
    }
    for (uint y = box.low.y; y < box.high.y; ++y) {
        for (uint x = box.low.x; x < box.high.x; ++x) {
            float weight = weight_of(box, uvec2(x, y));
            for (int i = 0; i < LOBE_COUNT; ++i)
                add_lobe(sums, ivec2(x, y), i, weight, nearest, units, densities);
            if (BIN_COLOUR || MASKED_LOBES)
                sums.diffuse +=
                    weight * texelFetch(sample_map, ivec3(x, y, LAYERS * LOBE_COUNT), 0);
        }
    }
    return sums;
}

void improve(level_box box, level_sums sums, bool by_distance, mixture_units units,
             inout mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    float whole = 0.0;
    for (int j = 0; j < BINS; ++j)
        whole += sums.moments[j].first.x;
    for (int j = 0; j < BINS; ++j) {
        components[j] = improved(components[j], sums.moments[j], whole, units);
        if (PROJECTED && constants.prior > 0.0 && !by_distance)
            components[j].mean.xy = drawn_to_neighbours(box, j, components[j]);
    }
}

// Components at samples far apart. false: no two lobes are further apart than shows.
bool start_apart(level_box box, mixture_units units,
                 inout mixture_component components[MIXTURE_MAXIMUM_COMPONENTS]) {
    for (int count = 0; count < BINS; ++count) {
        float farthest = -1.0;
        vec3 place = vec3(0.0);
        for (uint y = box.low.y; y < box.high.y; ++y) {
            for (uint x = box.low.x; x < box.high.x; ++x) {
                mixture_sample lobe = read_sample(ivec2(x, y), int((x + y) % LOBE_COUNT), units);
                float nearest = count == 0 ? squared_distance(lobe, vec3(0.0), units) : 1e30;
                // Unrolled: lavapipe leaves loops after 65535 turns in all.
                [[unroll]]
                for (int j = 0; j + 1 < BINS; ++j)
                    if (j < count)
                        nearest = min(nearest, squared_distance(lobe, components[j].mean, units));
                if (MASKED_LOBES)
                    nearest *= lobe.mass;
                if (nearest > farthest) {
                    farthest = nearest;
                    place = lobe.place;
                }
            }
        }
        components[count] = first_component(place, units);
        if (count == 1 && farthest <= LEAST_VARIANCE * units.deviation * units.deviation)
            return false;
    }
    return true;
}

#endif
