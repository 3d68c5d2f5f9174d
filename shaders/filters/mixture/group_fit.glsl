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
shared float own_numbers[NUMBERS][THREADS];
shared float numbers[NUMBERS];
shared mixture_component components[MOMENT_MAXIMUM_BINS];
shared float keys[THREADS];
shared uint key_samples[THREADS];

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

// Sums of all threads' own numbers.
void merge_sums() {
    const uint PARTS = 4, SIZE = THREADS / PARTS;
    barrier();
    uint number = thread() / PARTS, first = thread() % PARTS * SIZE;
    if (number < NUMBERS) {
        float sum = 0.0;
        for (uint i = 0; i < SIZE; ++i)
            sum += own_numbers[number][first + i];
        own_numbers[number][first] = sum;
    }
    barrier();
    if (thread() < NUMBERS) {
        float sum = 0.0;
        for (uint i = 0; i < PARTS; ++i)
            sum += own_numbers[thread()][i * SIZE];
        numbers[thread()] = sum;
    }
    barrier();
}

// One step, by shares or by distance.
void take_step(sampled_area area, bool nearest, mixture_units units) {
    component_density densities[MOMENT_MAXIMUM_BINS];
    component_sums sums[MOMENT_MAXIMUM_BINS];
    for (int j = 0; j < BINS; ++j) {
        densities[j] = density_of(components[j]);
        sums[j] = component_sums(vec4(0.0), vec4(0.0));
    }
    for (uint i = thread(); i < sample_count(area); i += THREADS) {
        mixture_sample lobe = area_sample(area, i, units);
        float shares[MOMENT_MAXIMUM_BINS];
        if (nearest)
            find_nearest(densities, lobe, shares);
        else
            find_shares(densities, lobe, shares);
        for (int j = 0; j < BINS; ++j)
            add_share(sums[j], densities[j].mean, lobe, lobe.mass * shares[j]);
    }
    component_sums whole[MOMENT_MAXIMUM_BINS];
    float mass = 0.0;
    for (int j = 0; j < BINS; ++j) {
        for (int k = 0; k < 4; ++k) {
            own_numbers[k][thread()] = sums[j].first[k];
            own_numbers[4 + k][thread()] = sums[j].second[k];
        }
        merge_sums();
        whole[j].first = vec4(numbers[0], numbers[1], numbers[2], numbers[3]);
        whole[j].second = vec4(numbers[4], numbers[5], numbers[6], numbers[7]);
        mass += numbers[0];
        barrier();
    }
    for (int j = 0; j < BINS; ++j)
        if (thread() == j)
            components[j] = improved(components[j], whole[j], mass, units);
    barrier();
}

// How much a sample should become component `count`: its squared distance from the nearest other.
// For k-means a random number decides in proportion to it.
float key_of(mixture_sample lobe, uint index, int count, uint start) {
    float nearest = 1e30;
    for (int j = 0; j < count; ++j) {
        vec3 d = lobe.place - components[j].mean;
        nearest = min(nearest, dot(d, d));
    }
    if (start == FAR_APART)
        return count == 0 ? dot(lobe.place, lobe.place) : nearest;
    float number = hashed_number(index * MOMENT_MAXIMUM_BINS + uint(count) + 77u);
    return (count == 0 ? 1.0 : nearest) / -log(max(number, 1e-7));
}

// Makes component `count` of the sample with the largest key.
void add_component(sampled_area area, int count, uint start, mixture_units units) {
    float best = -1.0;
    uint best_sample = 0;
    for (uint i = thread(); i < sample_count(area); i += THREADS) {
        float key = key_of(area_sample(area, i, units), i, count, start);
        if (key > best) {
            best = key;
            best_sample = i;
        }
    }
    keys[thread()] = best;
    key_samples[thread()] = best_sample;
    barrier();
    if (thread() == 0) {
        for (uint i = 1; i < THREADS; ++i) {
            if (keys[i] > best) {
                best = keys[i];
                best_sample = key_samples[i];
            }
        }
        components[count] = first_component(area_sample(area, best_sample, units).place, units);
    }
    barrier();
}

#endif
