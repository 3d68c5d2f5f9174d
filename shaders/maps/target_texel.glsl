#ifndef TARGET_TEXEL_GLSL
#define TARGET_TEXEL_GLSL

// Which texel of a level an invocation makes, in workgroups of 8 x 8: of the whole level, or, with
// SEEN_TILES, of its listed tiles.

#ifdef SEEN_TILES
#include "interface/map_tiles.h"

layout(set = 0, binding = 30, std430) readonly buffer tile_list_block { uint tile_list[]; };

// The upper left texel of the workgroup's square; false past the end of the list.
bool find_target_square(uint level, out ivec2 corner) {
    uint record = MAP_TILE_RECORD * level;
    uint index = gl_WorkGroupID.y * MAP_TILE_ROW + gl_WorkGroupID.x / MAP_TILE_GROUPS;
    corner = ivec2(0);
    if (index >= tile_list[record + MAP_TILE_COUNT])
        return false;
    uint tile = tile_list[tile_list[record + MAP_TILE_FIRST] + index];
    uint quarter = gl_WorkGroupID.x % MAP_TILE_GROUPS;
    corner = MAP_TILE * ivec2(tile & 0xffffu, tile >> 16) + 8 * ivec2(quarter & 1u, quarter >> 1);
    return true;
}
#else
bool find_target_square(uint level, out ivec2 corner) {
    corner = 8 * ivec2(gl_WorkGroupID.xy);
    return true;
}
#endif

// False outside of the level, whose texels are `extent`.
bool find_target_texel(uint level, ivec2 extent, out ivec2 texel) {
    ivec2 corner;
    bool listed = find_target_square(level, corner);
    texel = corner + ivec2(gl_LocalInvocationID.xy);
    return listed && all(lessThan(texel, extent));
}

#endif
