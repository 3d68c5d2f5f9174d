#ifndef LIB_FACET_BINS_GLSL
#define LIB_FACET_BINS_GLSL

// How much of a facet's normal belongs to each bin, by its place in the Lambert plane: what the
// terms of a mixture of Gaussians have of the density there. Then the normals of each bin are about
// Gaussian, as they are taken to be. Of bins with edges they are not: a disc about the pole has
// half the density there that a Gaussian of its variance has.
//
// Dempster, Laird, Rubin, 1977, Maximum Likelihood from Incomplete Data via the EM Algorithm.

#include "interface/displacement/relief.h"
#include "lib/number/constants.glsl"

// `groups`: of transfer_basis_constants.
void facet_parts(vec2 place, vec4 groups[2 * FACET_BINS], out float parts[FACET_BINS]) {
    float most = -1e30, sum = 0.0;
    for (uint k = 0u; k < FACET_BINS; ++k) {
        vec2 d = place - groups[2u * k].xy;
        vec3 squares = vec3(d * d, 2.0 * d.x * d.y);
        parts[k] = groups[2u * k].z - 0.5 * dot(groups[2u * k + 1u].xyz, squares);
        most = max(most, parts[k]);
    }
    for (uint k = 0u; k < FACET_BINS; ++k) {
        parts[k] = exp(parts[k] - most);
        sum += parts[k];
    }
    for (uint k = 0u; k < FACET_BINS; ++k)
        parts[k] /= sum;
}

// The covariance (xx, yy, xy) of a bin's places. `inverse`: of `groups`, with its determinant's
// inverse.
vec3 group_covariance(vec4 inverse) {
    return inverse.w * vec3(inverse.yx, -inverse.z);
}

// Where the mixture is looked for from: bin 0 near the pole, or the nearest half axis, +x, -x, +y,
// -y. `radius`: the mean distance of places from the pole.
uint first_facet_bin(vec2 place, float radius) {
    // Less than 1, so that facets that are all equally steep are not near the pole by rounding.
    const float NEAR = 0.9;
    if (length(place) < NEAR * radius)
        return 0u;
    vec2 size = abs(place);
    return size.x >= size.y ? (place.x >= 0.0 ? 1u : 2u) : (place.y >= 0.0 ? 3u : 4u);
}

// Directions that stand for equal parts of the upper hemisphere.
vec3 facet_direction(uint i) {
    const uint AROUND = 8u, UP = FACET_DIRECTIONS / AROUND;
    uint row = i / AROUND;
    float z = (float(row) + 0.5) / float(UP);
    float azimuth = 2.0 * PI / float(AROUND) * (float(i % AROUND) + 0.5 * float(row % 2u));
    return vec3(sqrt(1.0 - z * z) * vec2(cos(azimuth), sin(azimuth)), z);
}

// The integral of a direction's cosines to the carrier and to a facet that nothing hides: both
// positive, with this cosine between their normals.
float product_of_cosines(float cosine) {
    float between = acos(clamp(cosine, -1.0, 1.0));
    return 2.0 / 3.0 * (sin(between) + (PI - between) * cos(between));
}

#endif
