#version 460
#extension GL_GOOGLE_include_directive : require

// Lists the tiles of a map that are needed and have not been built yet, level by level from the
// coarsest to the finest. If tiles are built from those of the finer level, these are needed too.

#include "maps/map_tiles.glsl"

#define THREADS 256
layout(local_size_x = THREADS) in;

layout(push_constant) uniform constants_block { tile_list_constants map; };
layout(set = 0, binding = 0, std430) readonly buffer mark_block { uint marks[]; };
// The content that each tile was built from; 0: none.
layout(set = 0, binding = 1, std430) buffer state_block { uint states[]; };
layout(set = 0, binding = 2, std430) buffer tile_list_block { uint tile_list[]; };
layout(set = 0, binding = 3, std430) readonly buffer condition_block { uint condition[]; };

layout(set = 0, binding = 4, std430) readonly buffer made_with_block { uint made_with[]; };

shared uint appended;
shared uint content; // of a tile that is made now

// Above 0: FNV-1a (Fowler, Noll, Vo), whose products carry upwards alone. It takes bytes; of whole
// numbers the upper bits must come down, or two that change their signs leave the digest as it was.
uint digest_of_content() {
    uint number = map.content;
    for (uint i = 0u; i < map.made_with; ++i) {
        number = (number ^ made_with[i]) * 16777619u;
        number ^= number >> 15;
    }
    return max(number, 1u);
}

ivec2 extent_of(int level) {
    return extent_of_level(ivec2(map.width, map.height), level);
}

uint tile_count(int level) {
    ivec2 count = tiles_of_extent(extent_of(level));
    return uint(count.x * count.y);
}

// Whether a tile of the next coarser level is made of texels of this one. An odd row's last texel
// belongs to two: see lib/map/box_reduction.glsl.
bool serves_needed(ivec2 tile, int level, uint first_of_coarser) {
    ivec2 coarser = tiles_of_extent(extent_of(level + 1));
    ivec2 odd = extent_of(level) & 1;
    ivec2 last = min(tile / 2, coarser - 1);
    ivec2 first = max(min((tile * MAP_TILE - odd) / (2 * MAP_TILE), last), ivec2(0));
    bool needed = false;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            needed = needed || tile_list[first_of_coarser + uint(y * coarser.x + x)] != 0u;
    return needed;
}

void write_record(int level, uint first) {
    uint record = MAP_TILE_RECORD * uint(level);
    tile_list[record] = MAP_TILE_GROUPS * min(appended, MAP_TILE_ROW);
    tile_list[record + 1u] = (appended + MAP_TILE_ROW - 1u) / MAP_TILE_ROW;
    tile_list[record + 2u] = map.reduced != 0u && level > 0 ? map.layers : 1u;
    tile_list[record + MAP_TILE_COUNT] = appended;
    tile_list[record + MAP_TILE_FIRST] = first;
}

void main() {
    uint local = gl_LocalInvocationIndex, all = 0u;
    if (local == 0u)
        content = digest_of_content();
    bool wanted = map.conditional == 0u || condition[0] != 0u;
    for (int level = 0; level < int(map.levels); ++level)
        all += tile_count(level);
    // Of the level's tiles: their numbers, whether they are needed, and their list.
    uint end = all;
    const uint flags = MAP_TILE_RECORD * MAP_TILE_LEVELS;
    for (int level = int(map.levels) - 1; level >= 0; --level) {
        uint count = tile_count(level), first = end - count;
        int columns = tiles_of_extent(extent_of(level)).x;
        if (local == 0u)
            appended = 0u;
        memoryBarrierBuffer();
        barrier();
        for (uint i = local; i < count; i += THREADS) {
            ivec2 tile = ivec2(int(i) % columns, int(i) / columns);
            bool needed = wanted && marks[map.first_mark + first + i] != 0u;
            if (map.reduced != 0u && !needed && level + 1 < int(map.levels))
                needed = serves_needed(tile, level, flags + end);
            tile_list[flags + first + i] = needed ? 1u : 0u;
            uint built = map.forgets != 0u ? 0u : states[first + i];
            if (needed && built != content) {
                tile_list[flags + all + first + atomicAdd(appended, 1u)] =
                    uint(tile.x) | uint(tile.y) << 16;
                built = content;
            }
            states[first + i] = built;
        }
        memoryBarrierBuffer();
        barrier();
        if (local == 0u)
            write_record(level, flags + all + first);
        barrier();
        end = first;
    }
}
