#ifndef LIB_FACET_BINS_GLSL
#define LIB_FACET_BINS_GLSL

// Which bin a facet's normal belongs to, by its place in the Lambert plane: 0 near the pole, or the
// nearest half axis, +x, -x, +y, -y. Where most of a map is level and the rest steep, as are
// joints between bricks, one Gaussian would be too broad for both.

// As part of the mean distance from the pole. Less than 1, so that facets that are all equally
// steep are not near it by rounding.
const float FACET_BIN_NEAR = 0.9;

uint facet_bin_of(vec2 place, float radius) {
    if (length(place) < FACET_BIN_NEAR * radius)
        return 0u;
    vec2 size = abs(place);
    return size.x >= size.y ? (place.x >= 0.0 ? 1u : 2u) : (place.y >= 0.0 ? 3u : 4u);
}

// Moments are kept about it, so that half floats suffice.
vec2 facet_bin_centre(uint bin, float radius) {
    float distance = 1.4 * radius;
    return bin == 1u   ? vec2(distance, 0.0)
           : bin == 2u ? vec2(-distance, 0.0)
           : bin == 3u ? vec2(0.0, distance)
           : bin == 4u ? vec2(0.0, -distance)
                       : vec2(0.0);
}

#endif
