#ifndef COMPONENT_SEARCH_GLSL
#define COMPONENT_SEARCH_GLSL

// Search by a group for the components that are closest to the lobes of a rectangle of texels: from
// components far apart, from k-means, and from more components of which some are merged; where
// lobes differ in width, a second time with more weight on widths.

#define COMPONENTS 7 // MIXTURE_MAXIMUM_COMPONENTS
#include "filters/mixture/group_fit.glsl"
#include "filters/mixture/overlap.glsl"

const uint ROUNDS = 25;
const uint MERGED = 2; // the third kind of start
const uint KINDS = 3;
const uint STARTS = BIN_WIDTHS ? 2u * KINDS : KINDS;
const uint GIVEN = STARTS; // components are there already, and stay as they are

// Of squared distances along widths, in the second half of the starts. Where sharp and broad lobes
// are at one place, a component that has started with both hardly ever parts them.
const float WIDTH_WEIGHT = 10.0;

const float LEAST_GAIN = 0.02; // of the squared lobes, that it must be better than the others

shared mixture_component kept[BINS];

void keep_components() {
    if (thread() < BINS)
        kept[thread()] = components[thread()];
    barrier();
}

// ---------------------------------------------------------------------------------------------
// How close components are to the lobes

float overlap_of_all(mixture_sample lobe, mixture_units units) {
    float sum = 0.0;
    for (int j = 0; j < COMPONENTS; ++j)
        sum += overlap(components[j], lobe, units);
    return sum;
}

// The squared difference between all components and all lobes, integrated over the plane, without
// what does not depend on the components. (Likelihoods do not tell which of two fits a picture is
// better with.)
float squared_error(sampled_area area, mixture_units units) {
    // Of all lobes with all components, of all components with each other; the lobes' mass. One
    // loop, so that the code for an overlap exists once: compilers take seconds for this shader.
    vec3 sums = vec3(0.0);
    uint count = sample_count(area);
    for (uint i = thread(); i < count + COMPONENTS; i += THREADS) {
        bool is_lobe = i < count;
        mixture_sample other;
        if (is_lobe)
            other = area_sample(area, i, units);
        else
            other = as_sample(components[i - count]);
        float over = other.mass * overlap_of_all(other, units);
        sums += is_lobe ? vec3(over, 0.0, other.mass) : vec3(0.0, over, 0.0);
    }
    for (uint k = 0u; k < 3u; ++k)
        own_numbers[k][thread()] = sums[k];
    merge_sums(3);
    return numbers[1] - 2.0 * numbers[0] / numbers[2];
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

// From a start, to the components that their lobes make. With fewer components than the lobes have
// groups, which are best together is found from all groups: what is nearest is often something
// sharp and frequent that should stay alone.
float fit_from(sampled_area area, uint start, mixture_units units) {
    uint kind = start % KINDS;
    bool is_merged = start != GIVEN && kind == MERGED;
    uint count = is_merged ? COMPONENTS : BINS;
    units.width_weight = start < KINDS ? 1.0 : WIDTH_WEIGHT;
    set_aside(count);
    for (int j = 0; j < (start == GIVEN ? 0 : int(count)); ++j)
        add_component(area, j, is_merged ? FAR_APART : kind, units);
    uint rounds = start == GIVEN ? 0u : is_merged ? 2u * ROUNDS : ROUNDS;
    uint by_distance = kind == K_MEANS ? ROUNDS_OF_K_MEANS : 1u;
    for (uint round = 0; round < rounds; ++round) {
        if (round == ROUNDS)
            merge_components(units);
        mixture_units shape = units;
        shape.is_round = units.is_round && (round + 1u) % ROUNDS != 0u;
        take_step(area, round < by_distance, shape);
    }
    return squared_error(area, units);
}

// Keeps the components that a start leads to if their error is below `least`, which it lowers then.
bool keep_better(sampled_area area, uint start, mixture_units units, inout float least) {
    bool is_merged = start != GIVEN && start % KINDS == MERGED;
    if (is_merged && (BINS == 1u || BINS == COMPONENTS))
        return false;
    float error = fit_from(area, start, units);
    // Texels' own mixtures start better at components of the other starts, unless these miss
    // a group of lobes.
    if (is_merged)
        error += LEAST_GAIN * abs(least);
    if (error >= least)
        return false;
    least = error;
    keep_components();
    return true;
}

#endif
