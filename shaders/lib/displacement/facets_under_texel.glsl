#ifndef LIB_FACETS_UNDER_TEXEL_GLSL
#define LIB_FACETS_UNDER_TEXEL_GLSL

#include "lib/map/box_reduction.glsl"

// The facets under a texel of a map of half the size of a relief. Whoever includes this defines
// these two:
uint facet_index(ivec2 quad, bool upper);
// `weight`: all facets' together are one.
void add_facet(uint index, float weight);

// `size`: the relief's quads.
void add_facets_under(uvec2 texel, ivec2 size) {
    vec3 columns = box_weights(size.x, int(texel.x)), rows = box_weights(size.y, int(texel.y));
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            uint lower = facet_index(2 * ivec2(texel) + ivec2(x, y), false);
            add_facet(lower, 0.5 * columns[x] * rows[y]);
            add_facet(lower + 1u, 0.5 * columns[x] * rows[y]);
        }
    }
}

#endif
