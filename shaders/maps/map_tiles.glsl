#ifndef MAP_TILES_GLSL
#define MAP_TILES_GLSL

#include "interface/map_tiles.h"

// Texels of a level whose level 0 has `size`.
ivec2 extent_of_level(ivec2 size, int level) {
    return max(size >> level, ivec2(1));
}

ivec2 tiles_of_extent(ivec2 extent) {
    return (extent + MAP_TILE - 1) / MAP_TILE;
}

#endif
