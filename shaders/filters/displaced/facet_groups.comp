#version 460
#extension GL_GOOGLE_include_directive : require

// The mixture of Gaussians that sorts the normals of a map's facets into bins
// (lib/displacement/facet_bins.glsl): of the largest likelihood, by expectation and maximisation,
// for facets that are spread over the map and weighted with their areas. Then what the relief hides
// of them: what is seen of all facets is the carrier; and where these send light that others mirror
// onto them. One group.

#include "filters/displaced/height_field.glsl"
#include "lib/displacement/facet_bins.glsl"
#include "lib/displacement/second_facets.glsl"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/number/hash.glsl"

const uint THREADS = 64u, SIDE = 64u, STEPS = 25u;
// Deviations that bins have at least, as part of the mean distance of places from the pole: without
// them, a bin of equal normals would be infinitely narrow.
const float LEAST_DEVIATION = 0.06;
const uint SUMS = 6u * FACET_BINS;

layout(local_size_x = THREADS) in;

layout(set = 0, binding = 1, std430) buffer basis_block { transfer_basis_constants basis; };

shared float sums[THREADS][SUMS];
shared float totals[SUMS];
shared vec4 groups[2u * FACET_BINS];
shared vec4 seconds[FACET_DIRECTIONS];

vec3 normal_in_tangent_frame(vec4 corners, bool upper) {
    // The relief's y runs against the tangent frame's.
    return vec3(1.0, -1.0, 1.0) * facet_normal(facet_slope(corners, upper));
}

void add_facet(vec3 normal, bool is_first) {
    vec2 place = plane_from_direction(normal);
    float parts[FACET_BINS];
    if (is_first) {
        uint bin = first_facet_bin(place, height_extent.z);
        for (uint k = 0u; k < FACET_BINS; ++k)
            parts[k] = k == bin ? 1.0 : 0.0;
    } else {
        facet_parts(place, groups, parts);
    }
    for (uint k = 0u; k < FACET_BINS; ++k) {
        float area = parts[k] / normal.z;
        sums[gl_LocalInvocationIndex][6u * k] += area;
        sums[gl_LocalInvocationIndex][6u * k + 1u] += area * place.x;
        sums[gl_LocalInvocationIndex][6u * k + 2u] += area * place.y;
        sums[gl_LocalInvocationIndex][6u * k + 3u] += area * place.x * place.x;
        sums[gl_LocalInvocationIndex][6u * k + 4u] += area * place.y * place.y;
        sums[gl_LocalInvocationIndex][6u * k + 5u] += area * place.x * place.y;
    }
}

uvec2 squares_of_grid() {
    return min(uvec2(relief_size()), uvec2(SIDE));
}

// Of a quad anywhere in a square of a grid: what repeats with the grid is seen all over.
vec4 heights_in_square(uint i) {
    uvec2 size = uvec2(relief_size()), squares = squares_of_grid();
    uvec2 square = uvec2(i % squares.x, i / squares.x);
    uvec2 begin = square * size / squares, end = (square + 1u) * size / squares;
    uvec2 inside = uvec2(hash(i), hash(i + SIDE * SIDE)) % (end - begin);
    return quad_heights(ivec2(begin + inside));
}

void sum_facets(bool is_first) {
    for (uint i = 0u; i < SUMS; ++i)
        sums[gl_LocalInvocationIndex][i] = 0.0;
    uvec2 squares = squares_of_grid();
    for (uint i = gl_LocalInvocationIndex; i < squares.x * squares.y; i += THREADS) {
        vec4 corners = heights_in_square(i);
        add_facet(normal_in_tangent_frame(corners, false), is_first);
        add_facet(normal_in_tangent_frame(corners, true), is_first);
    }
}

void make_group(uint k) {
    float all = 0.0;
    for (uint i = 0u; i < FACET_BINS; ++i)
        all += totals[6u * i];
    float area = totals[6u * k], scale = 1.0 / max(area, 1e-12);
    vec2 mean = scale * vec2(totals[6u * k + 1u], totals[6u * k + 2u]);
    float least = max(LEAST_DEVIATION * height_extent.z, 1e-4);
    vec2 variance = scale * vec2(totals[6u * k + 3u], totals[6u * k + 4u]) - mean * mean;
    variance = max(variance, 0.0) + least * least;
    float covariance = scale * totals[6u * k + 5u] - mean.x * mean.y;
    float determinant =
        max(variance.x * variance.y - covariance * covariance, pow(least, 4.0));
    float part = log(max(area / all, 1e-12)) - 0.5 * log(determinant);
    groups[2u * k] = vec4(mean, part, area / all);
    groups[2u * k + 1u] = vec4(vec3(variance.yx, -covariance) / determinant, determinant);
}

float hidden_from(vec3 direction) {
    uvec2 squares = squares_of_grid();
    float facing = 0.0, count = 0.0;
    for (uint i = 0u; i < squares.x * squares.y; ++i) {
        vec4 corners = heights_in_square(i);
        for (uint k = 0u; k < 2u; ++k) {
            vec3 normal = normal_in_tangent_frame(corners, k == 1u);
            facing += max(dot(normal, direction), 0.0) / normal.z;
        }
        count += 2.0;
    }
    float seen = min(direction.z * count / max(facing, 1e-12), 1.0);
    return 2.0 * PI / float(FACET_DIRECTIONS) * direction.z * (1.0 - seen);
}

void main() {
    uint own = gl_LocalInvocationIndex;
    for (uint step = 0u; step < STEPS; ++step) {
        sum_facets(step == 0u);
        barrier();
        if (own < SUMS) {
            float total = 0.0;
            for (uint i = 0u; i < THREADS; ++i)
                total += sums[i][own];
            totals[own] = total;
        }
        barrier();
        if (own < FACET_BINS)
            make_group(own);
        barrier();
    }
    if (own < 2u * FACET_BINS)
        basis.groups[own] = groups[own];
    if (own < FACET_DIRECTIONS) {
        basis.hidden[own / 4u][own % 4u] = hidden_from(facet_direction(own));
        seconds[own] = seconds_of_direction(groups, second_direction(own));
    }
    barrier();
    if (own < FACET_BINS) {
        vec3 factors[SECOND_FACTORS];
        fit_second(seconds, direction_from_plane(groups[2u * own].xy), factors);
        for (uint i = 0u; i < SECOND_FACTORS; ++i)
            basis.second[SECOND_FACTORS * own + i] = vec4(factors[i], 0.0);
    }
}
