#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

// Marks the tiles of filtered maps that a pixel reads: of both levels that its probes interpolate
// between, the rectangle of texels from the first probe to the last. Nothing that a device may read
// is left out: samplers round coordinates and levels, and read texels whose weight is 0.

#include "shading/pixel.glsl"
#include "shading/map_area.glsl"
#include "interface/map_tiles.h"

layout(early_fragment_tests) in;

// MAP_NORMAL stands for the map of lobes.
layout(constant_id = SPECIALISE_FILTERED_MAPS) const uint FILTERED_MAPS = 0;

layout(set = 0, binding = 50, std140) uniform tile_block {
    tile_marking_constants maps[MAP_SHADING];
};
layout(set = 0, binding = 51, std430) buffer mark_block { uint marks[]; };

// How far apart shading and a sampler may be, in levels and in texels.
const float LEVEL_SLACK = 1.0 / 64.0;
const float TEXEL_SLACK = 1.0 / 32.0;

// A texel within a period of its wrapping, however a device rounds quotients.
float within_period(float texel, float size, uint wrap) {
    float period = wrap == TILE_WRAP_MIRROR ? 2.0 * size : size;
    float rest = texel - period * floor(texel / period);
    return rest < 0.0 ? rest + period : rest < period ? rest : rest - period;
}

// Tiles in a row, which may go on at the other end.
struct tile_range {
    uint first, count;
};

tile_range tiles_between(float first, float last) {
    uint begin = uint(first) >> MAP_TILE_SHIFT;
    return tile_range(begin, (uint(last) >> MAP_TILE_SHIFT) - begin + 1u);
}

// The tiles with the texels that interpolation from one coordinate to the other reads.
tile_range tiles_along(float low, float high, float size, uint wrap) {
    float reach = 0.5 + TEXEL_SLACK + 2e-6 * max(abs(low), abs(high)) * size;
    float first = floor(low * size - reach), last = floor(high * size + reach);
    tile_range all = tiles_between(0.0, size - 1.0);
    if (!(last - first < (wrap == TILE_WRAP_CLAMP ? 1e9 : size))) // or no number
        return all;
    if (wrap == TILE_WRAP_CLAMP)
        return tiles_between(clamp(first, 0.0, size - 1.0), clamp(last, 0.0, size - 1.0));
    first = within_period(first, size, wrap);
    last = within_period(last, size, wrap);
    if (wrap == TILE_WRAP_MIRROR) {
        bool turns = (first < size) != (last < size), at_end = first < last;
        first = first < size ? first : 2.0 * size - 1.0 - first;
        last = last < size ? last : 2.0 * size - 1.0 - last;
        return tiles_between(turns && !at_end ? 0.0 : min(first, last),
                             turns && at_end ? size - 1.0 : max(first, last));
    }
    tile_range result = tiles_between(first, last);
    if (last < first)
        result.count = min(result.count + all.count, all.count);
    return result;
}

// Loops in place of conditions: lavapipe skips no branch, and atomic operations take as long as a
// hundred others.
void mark(uint tile) {
    for (uint left = marks[tile] == 0u ? 1u : 0u; left > 0u; --left)
        atomicOr(marks[tile], 1u);
}

void mark_level(vec2 low, vec2 high, uvec2 wrap, tile_level level) {
    tile_range u = tiles_along(low.x, high.x, float(level.width), wrap.x);
    tile_range v = tiles_along(low.y, high.y, float(level.height), wrap.y);
    uint rows = (level.height + uint(MAP_TILE) - 1u) >> MAP_TILE_SHIFT;
    for (uint i = 0u; i < v.count; ++i) {
        uint row = v.first + i < rows ? v.first + i : v.first + i - rows;
        for (uint j = 0u; j < u.count; ++j) {
            uint column = u.first + j < level.columns ? u.first + j : u.first + j - level.columns;
            mark(level.first_mark + row * level.columns + column);
        }
    }
}

void mark_area(map_area area, int map) {
    float level = max(area.level - 1.0, 0.0);
    int last = int(maps[map].count) - 1;
    int finest = clamp(int(floor(level - LEVEL_SLACK)), 0, last);
    int coarsest = clamp(int(floor(level + LEVEL_SLACK)) + 1, 0, last);
    vec2 first = probe_position(area, 0u), second = probe_position(area, probes_of(area) - 1u);
    for (int i = finest; i <= coarsest; ++i)
        mark_level(min(first, second), max(first, second),
                   uvec2(maps[map].wrap_u, maps[map].wrap_v), maps[map].levels[i]);
}

void main() {
    surface_point surface = read_surface();
    // lavapipe would compute everything for maps that are passed over, too.
    for (uint left = FILTERED_MAPS; left != 0u; left &= left - 1u) {
        int map = findLSB(left);
        bool lobes = map == MAP_NORMAL;
        vec2 size = lobes ? lobe_map_size() : vec2(maps[map].width, maps[map].height);
        mark_area(area_of(lobes ? lobe_map() : map, size, surface), map);
    }
}
