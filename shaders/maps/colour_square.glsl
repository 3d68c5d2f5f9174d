#ifndef COLOUR_SQUARE_GLSL
#define COLOUR_SQUARE_GLSL

// A base colour map at the points of the four texels under a target texel, from the sixteen texels
// that these are interpolated between: a linear sampler reads four for each point, and a driver
// without hardware for that turns all of them from sRGB. Whoever includes this declares
// base_colour_map.

#include "lib/map/base_texel.glsl"
#include "maps/target_points.glsl"

layout(constant_id = SPECIALISE_COLOUR_SQUARE) const uint COLOUR_SQUARE = COLOUR_SQUARE_NONE;

const int SQUARE_POINTS = 4 * TEXEL_POINTS;

vec4 square_colours[SQUARE_POINTS];

// At most one texel beyond the map's edge, where clamping and mirroring are the same.
int texel_inside(int texel, int size, bool repeats) {
    int beyond = int(texel >= size) - int(texel < 0);
    return repeats ? texel - size * beyond : clamp(texel, 0, size - 1);
}

ivec2 square_texel(target_points points, int column, int row) {
    ivec2 texel = points.first + ivec2(column, row) - 1;
    return ivec2(texel_inside(texel.x, points.size.x,
                              (COLOUR_SQUARE & COLOUR_SQUARE_REPEATS_U) != 0u),
                 texel_inside(texel.y, points.size.y,
                              (COLOUR_SQUARE & COLOUR_SQUARE_REPEATS_V) != 0u));
}

// Before any of base_colour_at.
void read_colours(target_points points) {
    if (COLOUR_SQUARE == COLOUR_SQUARE_NONE)
        return;
    vec4 texels[16];
    for (int i = 0; i < 16; ++i)
        texels[i] = texelFetch(base_colour_map, square_texel(points, i % 4, i / 4), 0);
    const float NEXT = TEXEL_POINT, OWN = 1.0 - TEXEL_POINT;
    for (int i = 0; i < SQUARE_POINTS; ++i) {
        int texel = i / TEXEL_POINTS, side = i % TEXEL_POINTS == 0 ? 1 : -1;
        int own = 4 * (1 + texel / 2) + 1 + texel % 2;
        square_colours[i] =
            finite_or_zero(OWN * (OWN * texels[own] + NEXT * texels[own + side]) +
                           NEXT * (OWN * texels[own + 4 * side] + NEXT * texels[own + 5 * side]));
    }
}

vec4 base_colour_at(target_point point) {
    return COLOUR_SQUARE == COLOUR_SQUARE_NONE ? base_texel(base_colour_map, point.place)
                                               : square_colours[point.index];
}

#endif
