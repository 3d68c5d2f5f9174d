#ifndef LIB_SECOND_FACETS_GLSL
#define LIB_SECOND_FACETS_GLSL

// Where light goes that facets mirror onto others of a relief, which mirror it once more: for a
// direction d of the light between, the mean of the directions that it leaves in. For each bin of
// the facets that send it, it is taken for a polynomial of second degree in d, so that of many d
// only the moments count.

#include "interface/displacement/relief.h"
#include "lib/displacement/facet_bins.glsl"
#include "lib/microfacet/facing_area.glsl"

// Sums over directions of light.
struct light_moments {
    vec3 first;
    vec3 squares;  // xx, yy, zz: their sum is the light
    vec3 products; // yz, zx, xy
};

light_moments no_moments() {
    return light_moments(vec3(0.0), vec3(0.0), vec3(0.0));
}

void add_moments(inout light_moments sum, float weight, vec3 direction) {
    sum.first += weight * direction;
    sum.squares += weight * direction * direction;
    sum.products += weight * direction.yzx * direction.zxy;
}

// `factors`: of transfer_basis_constants, of the moments of each bin in their order.
vec3 directions_from_second(light_moments light, vec4 factors[SECOND_FACTORS * FACET_BINS],
                            uint bin) {
    uint first = SECOND_FACTORS * bin;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 3u; ++i)
        sum += light.first[i] * factors[first + i].xyz +
               light.squares[i] * factors[first + 3u + i].xyz +
               light.products[i] * factors[first + 6u + i].xyz;
    return sum;
}

// The sum over the facets that light meets, each by what it shows to it, and these areas.
vec4 seconds_of_direction(vec4 groups[2 * FACET_BINS], vec3 direction) {
    vec3 sum = vec3(0.0);
    float area = 0.0;
    for (uint k = 0u; k < FACET_BINS; ++k) {
        vec2 place = groups[2u * k].xy;
        vec3 moments =
            group_covariance(groups[2u * k + 1u]) + vec3(place * place, place.x * place.y);
        seen_facets seen = seen_facets_of(
            facet_spread_of(normal_spread_of(place, moments), groups[2u * k].w), -direction);
        vec3 normal = normalize(seen.mean);
        float between = dot(normal, direction);
        // Directions turn twice as far as normals, across the plane of both less.
        sum += seen.area * exp(-seen.spread * (1.0 + between * between)) *
               reflect(direction, normal);
        area += seen.area;
    }
    return vec4(sum, area);
}

// Directions that stand for equal parts of the sphere.
vec3 second_direction(uint i) {
    vec3 upper = facet_direction(i);
    float z = 2.0 * upper.z - 1.0;
    return vec3(sqrt((1.0 - z * z) / (1.0 - upper.z * upper.z)) * upper.xy, z);
}

// The factors of a bin, by least squares over directions that facets of its mean normal send light
// to, each by how much it meets of others. `seconds`: of all of second_direction().
void fit_second(vec4 seconds[FACET_DIRECTIONS], vec3 normal, out vec3 factors[SECOND_FACTORS]) {
    float rows[SECOND_FACTORS][SECOND_FACTORS];
    float weights = 0.0;
    for (uint i = 0u; i < SECOND_FACTORS; ++i) {
        factors[i] = vec3(0.0);
        for (uint j = 0u; j < SECOND_FACTORS; ++j)
            rows[i][j] = 0.0;
    }
    for (uint k = 0u; k < FACET_DIRECTIONS; ++k) {
        vec3 d = second_direction(k);
        float sent = max(dot(d, normal), 0.0), weight = sent * seconds[k].w;
        float terms[SECOND_FACTORS] = float[SECOND_FACTORS](
            d.x, d.y, d.z, d.x * d.x, d.y * d.y, d.z * d.z, d.y * d.z, d.z * d.x, d.x * d.y);
        for (uint i = 0u; i < SECOND_FACTORS; ++i) {
            factors[i] += sent * terms[i] * seconds[k].xyz;
            for (uint j = 0u; j < SECOND_FACTORS; ++j)
                rows[i][j] += weight * terms[i] * terms[j];
        }
        weights += weight;
    }
    // Gauss and Jordan; the matrix is positive.
    for (uint i = 0u; i < SECOND_FACTORS; ++i)
        rows[i][i] += 1e-4 * weights + 1e-9;
    for (uint i = 0u; i < SECOND_FACTORS; ++i) {
        float scale = 1.0 / rows[i][i];
        factors[i] *= scale;
        for (uint j = 0u; j < SECOND_FACTORS; ++j)
            rows[i][j] *= scale;
        for (uint k = 0u; k < SECOND_FACTORS; ++k) {
            float part = k == i ? 0.0 : rows[k][i];
            factors[k] -= part * factors[i];
            for (uint j = 0u; j < SECOND_FACTORS; ++j)
                rows[k][j] -= part * rows[i][j];
        }
    }
}

#endif
