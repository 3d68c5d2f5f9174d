#ifndef LIB_FACET_POINTS_GLSL
#define LIB_FACET_POINTS_GLSL

// Where maps are read in a facet, so that none of their texels is missed.

// The points along a side, of a map that lies on so many quads: at most 8.
uint facet_points(ivec2 map_size, ivec2 quads) {
    const uint MOST_POINTS = 8u;
    vec2 texels = ceil(vec2(map_size) / vec2(quads));
    return clamp(uint(max(texels.x, texels.y)), 1u, MOST_POINTS);
}

// Within the facet's quad: the middle of part `i` of `points` * `points` triangles that the facet
// is divided into.
vec2 point_in_facet(uint i, uint points, bool upper) {
    uint column = uint(sqrt(float(i) + 0.5)), row = i - column * column;
    vec2 inside = (row & 1u) == 0u ? vec2(2.0, 1.0) / 3.0 : vec2(1.0, 2.0) / 3.0;
    inside = (vec2(column, row / 2u) + inside) / float(points);
    return upper ? inside.yx : inside;
}

#endif
