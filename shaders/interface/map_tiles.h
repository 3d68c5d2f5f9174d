#ifndef INTERFACE_MAP_TILES_H
#define INTERFACE_MAP_TILES_H

#include "types.h"

// Tiles of filtered maps. Each level is cut into squares of MAP_TILE texels, row by row from
// the upper left; tiles are numbered level by level, from level 0 on.
#define MAP_TILE        16 // texels
#define MAP_TILE_SHIFT  4
#define MAP_TILE_GROUPS 4  // workgroups of 8 x 8 that a tile takes
#define MAP_TILE_LEVELS 14 // at most: those of a map made from 16384 texels

// A list of tiles for each level, in one buffer of uint:
//   MAP_TILE_LEVELS records of MAP_TILE_RECORD: arguments of an indirect dispatch, count, first;
//   for each tile of the map, whether it is needed;
//   for each level, column | row << 16 of the tiles that are to be built, from `first` on.
#define MAP_TILE_RECORD 5
// Of a record; an indirect dispatch has at most as many groups in each dimension as every device
// allows.
#define MAP_TILE_COUNT 3
#define MAP_TILE_FIRST 4
#define MAP_TILE_ROW   4096 // tiles

// Push constants of the pass that lists the tiles to build.
struct tile_list_constants {
    uint first_mark;
    uint width; // of level 0, texels
    uint height;
    uint levels;
    uint layers;
    uint content;     // number of the maps' content (lobe_dispatch.numbered), above 0
    uint forgets;     // 1: no tile has been built yet, or all are to be built again
    uint reduced;     // 1: tiles are built from those of the finer level; 0: from the base maps
    uint conditional; // 1: no tile is needed where the condition's first number is 0
    uint made_with;   // numbers of a buffer that tiles are made with; those count as content, too
};
INTERFACE_SIZE(tile_list_constants, 40)
INTERFACE_OFFSET(tile_list_constants, width, 4)
INTERFACE_OFFSET(tile_list_constants, height, 8)
INTERFACE_OFFSET(tile_list_constants, levels, 12)
INTERFACE_OFFSET(tile_list_constants, layers, 16)
INTERFACE_OFFSET(tile_list_constants, content, 20)
INTERFACE_OFFSET(tile_list_constants, forgets, 24)
INTERFACE_OFFSET(tile_list_constants, reduced, 28)
INTERFACE_OFFSET(tile_list_constants, conditional, 32)
INTERFACE_OFFSET(tile_list_constants, made_with, 36)

struct tile_level {
    uint first_mark; // of the level's tiles
    uint columns;    // of tiles
    uint width;      // texels
    uint height;
};
INTERFACE_SIZE(tile_level, 16)
INTERFACE_OFFSET(tile_level, columns, 4)
INTERFACE_OFFSET(tile_level, width, 8)
INTERFACE_OFFSET(tile_level, height, 12)

#ifdef VULKAN
#define TILE_LEVEL tile_level
#else
#define TILE_LEVEL struct tile_level
#endif

// How a draw marks the tiles of a map that its pixels read (std140), in a uniform block with one
// for each map that shading binds. That of MAP_NORMAL is for the map of lobes.
struct tile_marking_constants {
    uint count;  // of levels; 0: none is marked
    uint wrap_u; // TILE_WRAP_...
    uint wrap_v;
    uint width; // of what the map is made from, texels; not used for the map of lobes
    uint height;
    uint padding_0;
    uint padding_1;
    uint padding_2;
    TILE_LEVEL levels[MAP_TILE_LEVELS];
};
INTERFACE_SIZE(tile_marking_constants, 32 + 16 * MAP_TILE_LEVELS)
INTERFACE_OFFSET(tile_marking_constants, wrap_u, 4)
INTERFACE_OFFSET(tile_marking_constants, wrap_v, 8)
INTERFACE_OFFSET(tile_marking_constants, width, 12)
INTERFACE_OFFSET(tile_marking_constants, height, 16)
INTERFACE_OFFSET(tile_marking_constants, levels, 32)

#define TILE_WRAP_REPEAT 0
#define TILE_WRAP_MIRROR 1
#define TILE_WRAP_CLAMP  2

#endif
