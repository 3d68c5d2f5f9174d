#version 460
#extension GL_GOOGLE_include_directive : require

// The mixture of all of a material's lobes, where the mixtures of its coarsest level start: of
// round or of oval components, whichever are closest to the lobes. Also the units of the mixture's
// map. One group.

#include "filters/mixture/component_search.glsl"

layout(set = 0, binding = 16) uniform writeonly image2DArray component_map;
layout(set = 0, binding = 17, std430) readonly buffer extremes_block {
    mixture_extremes extremes[];
};
layout(set = 0, binding = 19, std430) writeonly buffer binning_block {
    moment_binning_constants binning;
};

// Along each side: of all texels, so many are sampled. lavapipe leaves all loops of a thread when
// it has gone through them 65535 times in all.
const uint CELLS = LOBE_COUNT > 2u ? 32u : LOBE_COUNT == 2u && BIN_WIDTHS ? 48u : 64u;

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
    return mixture_units(0.5 * (low + high), sqrt(sqrt(variance) / sharpness), false, 1.0);
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

// True: of round components.
bool fit(sampled_area area, mixture_units units) {
    float least_error = 1e38;
    bool is_round = false;
    for (uint i = 0; i < 2 * STARTS; ++i) {
        units.is_round = i < STARTS;
        if ((SHAPE == MIXTURE_SHAPE_ROUND && !units.is_round) ||
            (SHAPE == MIXTURE_SHAPE_OVAL && units.is_round))
            continue;
        if (keep_better(area, i % STARTS, units, least_error))
            is_round = units.is_round;
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
