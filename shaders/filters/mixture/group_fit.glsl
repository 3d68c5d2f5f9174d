#ifndef GROUP_FIT_GLSL
#define GROUP_FIT_GLSL

// Expectation maximisation by a group, over a sample of the lobes of a rectangle of texels. All
// sums are in a fixed order.

#include "filters/mixture/components.glsl"
#include "lib/number/hash.glsl"

const uint THREADS = 64;

layout(local_size_x = THREADS) in;

// A rectangle of texels, cut into cells with one sample each.
struct sampled_area {
    uvec2 low, size;
    uvec2 cells;
};

// Starts: components far apart (Gonzalez 1985), or at random ones, from which k-means go (Lloyd
// 1982; Arthur, Vassilvitskii 2007).
const uint FAR_APART = 0, K_MEANS = 1;
const uint ROUNDS_OF_K_MEANS = 8;

const uint NUMBERS = 8; // of component_sums
shared float own_numbers[NUMBERS * COMPONENTS][THREADS];
shared float numbers[NUMBERS * COMPONENTS];
shared component_density densities[COMPONENTS];
shared mixture_component components[COMPONENTS];
shared float keys[THREADS];
shared uint chosen_thread;

uint thread() {
    return gl_LocalInvocationID.x;
}

// At most `most` cells along either side.
sampled_area make_area(uvec2 low, uvec2 size, uint most) {
    return sampled_area(low, size, min(size, uvec2(most)));
}

uint sample_count(sampled_area area) {
    return area.cells.x * area.cells.y * LOBE_COUNT;
}

// The texel at a hashed place in the sample's cell.
mixture_sample area_sample(sampled_area area, uint index, mixture_units units) {
    uint cell_index = index / LOBE_COUNT;
    uvec2 cell = uvec2(cell_index % area.cells.x, cell_index / area.cells.x);
    uvec2 low = cell * area.size / area.cells, high = (cell + 1u) * area.size / area.cells;
    vec2 part = vec2(hashed_number(2u * cell_index), hashed_number(2u * cell_index + 1u));
    uvec2 texel = min(low + uvec2(part * vec2(high - low)), high - 1u);
    return read_sample(ivec2(area.low + texel), int(index % LOBE_COUNT), units);
}

// Sums of the first `count` of all threads' own numbers.
void merge_sums(uint count) {
    const uint PARTS = 4, SIZE = THREADS / PARTS;
    barrier();
    uint first = thread() % PARTS * SIZE;
    for (uint number = thread() / PARTS; number < count; number += THREADS / PARTS) {
        float sum = 0.0;
        for (uint i = 0; i < SIZE; ++i)
            sum += own_numbers[number][first + i];
        own_numbers[number][first] = sum;
    }
    barrier();
    if (thread() < count) {
        float sum = 0.0;
        for (uint i = 0; i < PARTS; ++i)
            sum += own_numbers[thread()][i * SIZE];
        numbers[thread()] = sum;
    }
    barrier();
}

component_sums merged_sums(uint index) {
    uint i = NUMBERS * index;
    return component_sums(vec4(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]),
                          vec4(numbers[i + 4], numbers[i + 5], numbers[i + 6], numbers[i + 7]));
}

// From the merged sums; a thread for each component.
void improve_components(mixture_units units) {
    float whole = 0.0;
    for (int j = 0; j < COMPONENTS; ++j)
        whole += numbers[NUMBERS * j];
    if (thread() < COMPONENTS)
        components[thread()] =
            improved(components[thread()], merged_sums(thread()), whole, units);
    barrier();
}

// One step, by shares or by distance.
void take_step(sampled_area area, bool nearest, mixture_units units) {
    if (thread() < COMPONENTS)
        densities[thread()] = density_of(components[thread()]);
    barrier();
    component_density own[MIXTURE_MAXIMUM_COMPONENTS];
    component_sums sums[MIXTURE_MAXIMUM_COMPONENTS];
    for (int j = 0; j < COMPONENTS; ++j) {
        own[j] = densities[j];
        sums[j] = component_sums(vec4(0.0), vec4(0.0));
    }
    for (uint i = thread(); i < sample_count(area); i += THREADS) {
        mixture_sample lobe = area_sample(area, i, units);
        float shares[MIXTURE_MAXIMUM_COMPONENTS];
        share_out(own, lobe, nearest, units, shares);
        for (int j = 0; j < COMPONENTS; ++j)
            add_share(sums[j], own[j].mean, lobe, lobe.mass * shares[j]);
    }
    for (int j = 0; j < COMPONENTS; ++j) {
        for (int k = 0; k < 4; ++k) {
            own_numbers[NUMBERS * j + k][thread()] = sums[j].first[k];
            own_numbers[NUMBERS * j + 4 + k][thread()] = sums[j].second[k];
        }
    }
    merge_sums(NUMBERS * COMPONENTS);
    improve_components(units);
}

// How much a sample should become component `count`: its squared distance from the nearest other,
// and what it counts under a mask. For k-means a random number decides in proportion to it.
float key_of(mixture_sample lobe, uint index, int count, uint start, mixture_units units) {
    float nearest = 1e30, weight = MASKED_LOBES ? lobe.mass : 1.0;
    for (int j = 0; j < count; ++j)
        nearest = min(nearest, squared_distance(lobe, components[j].mean, units));
    if (start == FAR_APART)
        return weight * (count == 0 ? squared_distance(lobe, vec3(0.0), units) : nearest);
    float number = hashed_number(index * MOMENT_MAXIMUM_BINS + uint(count) + 77u);
    return weight * (count == 0 ? 1.0 : nearest) / -log(max(number, 1e-7));
}

// Makes component `count` of the sample with the largest key.
void add_component(sampled_area area, int count, uint start, mixture_units units) {
    float best = -1.0;
    vec3 best_place = vec3(0.0);
    for (uint i = thread(); i < sample_count(area); i += THREADS) {
        mixture_sample lobe = area_sample(area, i, units);
        float key = key_of(lobe, i, count, start, units);
        if (key > best) {
            best = key;
            best_place = lobe.place;
        }
    }
    keys[thread()] = best;
    barrier();
    if (thread() == 0) {
        chosen_thread = 0;
        for (uint i = 1; i < THREADS; ++i) {
            if (keys[i] > keys[chosen_thread])
                chosen_thread = i;
        }
    }
    barrier();
    if (thread() == chosen_thread)
        components[count] = first_component(best_place, units);
    barrier();
}

#endif
