#ifndef MAP_POINTS_GLSL
#define MAP_POINTS_GLSL

// The points inside a texel at which passes read the maps that they filter.

#include "lib/map/texel_point.glsl"
#include "interface/specialisation.h"

layout(constant_id = SPECIALISE_INTERPOLATED) const bool INTERPOLATED = false;
layout(constant_id = SPECIALISE_MANY_POINTS) const bool MANY_POINTS = false;

// Points of a texel: its centre where no map differs inside it.
const int POINTS = MANY_POINTS ? MANY_TEXEL_POINTS : INTERPOLATED ? TEXEL_POINTS : 1;

// Point `index` of POINTS of a texel, in the coordinates of all maps; `size`: texels of the larger.
vec2 map_point(ivec2 texel, int index, ivec2 size) {
    vec2 offset = MANY_POINTS    ? many_texel_point(index)
                  : INTERPOLATED ? texel_point(index)
                                 : vec2(0.0);
    return (vec2(texel) + 0.5 + offset) / vec2(size);
}

#endif
