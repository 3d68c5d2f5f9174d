#ifndef LIB_FACET_POINTS_GLSL
#define LIB_FACET_POINTS_GLSL

// Where maps are read in a facet, so that none of their texels is missed.

// Within the facet's quad: the middle of part `i` of `points` * `points` triangles that the facet
// is divided into.
vec2 point_in_facet(uint i, uint points, bool upper) {
    uint column = uint(sqrt(float(i) + 0.5)), row = i - column * column;
    vec2 inside = (row & 1u) == 0u ? vec2(2.0, 1.0) / 3.0 : vec2(1.0, 2.0) / 3.0;
    inside = (vec2(column, row / 2u) + inside) / float(points);
    return upper ? inside.yx : inside;
}

#endif
