#version 460
#extension GL_GOOGLE_include_directive : require

// The mixture of all of a material's lobes, where the mixtures of its coarsest level start: from
// components far apart, from k-means, and from more components of which some are merged, of round
// and of oval ones, whichever are closest to the lobes in the end. Also the units of the mixture's
// map. One group.

#define COMPONENTS 7 // MIXTURE_MAXIMUM_COMPONENTS
#include "filters/mixture/group_fit.glsl"
#include "lib/lobe/plane_gaussian.glsl"

layout(set = 0, binding = 16) uniform writeonly image2DArray component_map;
layout(set = 0, binding = 17, std430) readonly buffer extremes_block {
    mixture_extremes extremes[];
};
layout(set = 0, binding = 19, std430) writeonly buffer binning_block {
    moment_binning_constants binning;
};

// Along each side: of all texels, so many are sampled. lavapipe leaves all loops of a thread when
// it has gone through them 65535 times in all.
const uint CELLS = LOBE_COUNT > 2u ? 32u : 64u;
const uint ROUNDS = 25;
const uint MERGED = 2; // the third start
const float LEAST_GAIN = 0.02; // of the squared lobes, that it must be better than the others

shared mixture_component kept[BINS];

mixture_extremes find_extremes() {
    mixture_extremes own = mixture_extremes(vec4(1e30), vec4(1e30));
    for (uint i = thread(); i < uint(extremes.length()); i += THREADS) {
        own.places = min(own.places, extremes[i].places);
        own.lobes = min(own.lobes, extremes[i].lobes);
    }
    for (int k = 0; k < 4; ++k) {
        own_numbers[k][thread()] = own.places[k];
        own_numbers[4 + k][thread()] = own.lobes[k];
    }
    barrier();
    if (thread() < 8) {
        float number = 1e30;
        for (uint i = 0; i < THREADS; ++i)
            number = min(number, own_numbers[thread()][i]);
        numbers[thread()] = number;
    }
    barrier();
    return mixture_extremes(vec4(numbers[0], numbers[1], numbers[2], numbers[3]),
                            vec4(numbers[4], numbers[5], numbers[6], numbers[7]));
}

// Of lobes between the sharpest and the broadest.
mixture_units find_units(mixture_extremes least) {
    vec2 low = least.places.xy, high = -least.places.zw;
    float sharpness = -least.lobes.x, variance = -least.lobes.y;
    return mixture_units(0.5 * (low + high), sqrt(sqrt(variance) / sharpness), false);
}

void write_units(mixture_extremes least, mixture_units units) {
    vec2 half_size = 0.5 * (-least.places.zw - least.places.xy);
    float reach = max(1.001 * max(half_size.x, half_size.y), 1e-6);
    if (thread() < MOMENT_MAXIMUM_BINS)
        binning.bins[thread()] =
            moment_bin(vec4(0.0), vec4(vec3(0.0), -1.001 * least.lobes.y),
                       vec4(units.origin, reach, -1.001 * least.lobes.x));
    if (thread() == 0) {
        binning.largest = vec4(max(-1.001 * least.lobes.z, 1e-6),
                               max(BIN_COLOUR ? -least.lobes.w : 1.0, 1e-6), 0.0, 0.0);
    }
}

void keep_components() {
    if (thread() < BINS)
        kept[thread()] = components[thread()];
    barrier();
}

// ---------------------------------------------------------------------------------------------
// How close components are to the lobes

// The variance of base lobes of a width.
vec3 base_covariance(float width, mixture_units units) {
    float deviation = units.deviation * exp(width / units.deviation);
    return vec3(vec2(deviation * deviation), 0.0);
}

// The integral of a component with base lobes, times the sample's lobe, for all components.
float overlap_with_sample(mixture_sample lobe, mixture_units units) {
    float sum = 0.0;
    for (int j = 0; j < COMPONENTS; ++j)
        sum += components[j].part *
               evaluate_plane_gaussian(
                   make_plane_gaussian(components[j].covariance.xyz + lobe.covariance +
                                           base_covariance(components[j].mean.z, units) +
                                           base_covariance(lobe.place.z, units),
                                       1.0),
                   lobe.place.xy - components[j].mean.xy);
    return sum;
}

// The squared difference between all components and all lobes, integrated over the plane, without
// what does not depend on the components. (Likelihoods do not tell which of two fits a picture is
// better with.)
float squared_error(sampled_area area, mixture_units units) {
    float overlap = 0.0, mass = 0.0;
    for (uint i = thread(); i < sample_count(area); i += THREADS) {
        mixture_sample lobe = area_sample(area, i, units);
        overlap += lobe.mass * overlap_with_sample(lobe, units);
        mass += lobe.mass;
    }
    own_numbers[0][thread()] = overlap;
    own_numbers[1][thread()] = mass;
    merge_sums(2);
    float error = -2.0 * numbers[0] / numbers[1];
    for (int j = 0; j < COMPONENTS; ++j) {
        mixture_sample as_sample =
            mixture_sample(components[j].mean, components[j].covariance.xyz, vec2(0.0), 1.0);
        error += components[j].part * overlap_with_sample(as_sample, units);
    }
    barrier();
    return error;
}

// ---------------------------------------------------------------------------------------------
// All fits

// So far away that they get nothing.
void set_aside(uint first) {
    barrier();
    if (thread() >= first && thread() < COMPONENTS)
        components[thread()] =
            mixture_component(0.0, vec3(1e6, 1e6, 0.0), vec4(1.0, 1.0, 0.0, 1.0));
    barrier();
}

mixture_component merged(mixture_component a, mixture_component b) {
    mixture_component sum;
    sum.part = a.part + b.part;
    float share = b.part / max(sum.part, 1e-30);
    vec3 d = b.mean - a.mean;
    sum.mean = a.mean + share * d;
    sum.covariance = mix(a.covariance, b.covariance, share) +
                     share * (1.0 - share) * vec4(d.xy * d.xy, d.x * d.y, d.z * d.z);
    return sum;
}

// The logarithm of the volume of a component with the usual base lobe.
float log_volume(mixture_component component, mixture_units units) {
    vec4 c = component.covariance + units.deviation * units.deviation * vec4(1.0, 1.0, 0.0, 1.0);
    float volume = c.x * c.y - c.z * c.z;
    return log(max(BIN_WIDTHS ? volume * c.w : volume, 1e-37));
}

// What a merger loses at most: Runnalls 2007, A Kullback-Leibler Approach to Gaussian Mixture
// Reduction, Eq. 21.
float loss_of_merger(mixture_component a, mixture_component b, mixture_units units) {
    return (a.part + b.part) * log_volume(merged(a, b), units) -
           a.part * log_volume(a, units) - b.part * log_volume(b, units);
}

// Two at a time, those that lose least. One thread.
void merge_once(uint count, mixture_units units) {
    float least = 1e38;
    uvec2 pair = uvec2(0u, 1u);
    for (uint i = 0u; i < count; ++i) {
        for (uint j = i + 1u; j < count; ++j) {
            float loss = loss_of_merger(components[i], components[j], units);
            if (loss < least) {
                least = loss;
                pair = uvec2(i, j);
            }
        }
    }
    components[pair.x] = merged(components[pair.x], components[pair.y]);
    components[pair.y] = components[count - 1u];
}

void merge_components(mixture_units units) {
    for (uint count = COMPONENTS; count > BINS; --count) {
        barrier();
        if (thread() == 0u)
            merge_once(count, units);
    }
    set_aside(BINS);
}

void take_steps(sampled_area area, uint by_distance, mixture_units units) {
    for (uint round = 0; round < ROUNDS; ++round) {
        mixture_units shape = units;
        shape.is_round = units.is_round && round + 1u < ROUNDS;
        take_step(area, round < by_distance, shape);
    }
}

// From a start, to the components that their lobes make. With fewer components than the lobes have
// groups, which are best together is found from all groups: what is nearest is often something
// sharp and frequent that should stay alone.
float fit_from(sampled_area area, uint start, mixture_units units) {
    uint count = start == MERGED ? COMPONENTS : BINS;
    set_aside(count);
    for (int j = 0; j < int(count); ++j)
        add_component(area, j, start == MERGED ? FAR_APART : start, units);
    take_steps(area, start == K_MEANS ? ROUNDS_OF_K_MEANS : 1u, units);
    if (start == MERGED) {
        merge_components(units);
        take_steps(area, 0u, units);
    }
    return squared_error(area, units);
}

// True: of round components.
bool fit(sampled_area area, mixture_units units) {
    float least_error = 1e38;
    bool is_round = false;
    for (uint i = 0; i < 6; ++i) {
        uint start = i % 3u;
        units.is_round = i < 3;
        if ((SHAPE == MIXTURE_SHAPE_ROUND && !units.is_round) ||
            (SHAPE == MIXTURE_SHAPE_OVAL && units.is_round) ||
            (start == MERGED && (BINS == 1u || BINS == COMPONENTS)))
            continue;
        float error = fit_from(area, start, units);
        // Texels' own mixtures start better at components of the other starts, unless these miss
        // a group of lobes.
        if (start == MERGED)
            error += LEAST_GAIN * abs(least_error);
        if (error < least_error) {
            least_error = error;
            is_round = units.is_round;
            keep_components();
        }
    }
    return is_round;
}

void main() {
    mixture_extremes least = find_extremes();
    mixture_units units = find_units(least);
    write_units(least, units);
    bool is_round =
        fit(make_area(uvec2(0), uvec2(constants.width, constants.height), CELLS), units);
    if (thread() == 0)
        binning.hats = vec4(units.origin, units.deviation, is_round ? 1.0 : 0.0);
    if (thread() < BINS) {
        int j = int(thread());
        imageStore(component_map, ivec3(0, 0, 2 * j), vec4(kept[j].part, kept[j].mean));
        imageStore(component_map, ivec3(0, 0, 2 * j + 1), kept[j].covariance);
    }
}
