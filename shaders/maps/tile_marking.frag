#version 460
#extension GL_GOOGLE_include_directive : require

// Marks the tiles of filtered maps that a pixel reads: of both levels that its probes interpolate
// between, the texels around each probe. Nothing that a device may read is left out: samplers round
// coordinates and levels, and read texels whose weight is 0.

#include "shading/pixel.glsl"
#include "shading/map_area.glsl"
#include "interface/map_tiles.h"

layout(early_fragment_tests) in;

layout(set = 0, binding = 50, std140) uniform tile_block {
    tile_marking_constants maps[MAP_SHADING];
};
layout(set = 0, binding = 51, std430) buffer mark_block { uint marks[]; };

// How far apart shading and a sampler may be, in levels and in texels.
const float LEVEL_SLACK = 1.0 / 64.0;
const float TEXEL_SLACK = 1.0 / 32.0;

// A coordinate within the first period of its wrapping.
float within_period(float coordinate, uint wrap) {
    if (wrap == TILE_WRAP_CLAMP)
        return clamp(coordinate, -1.0, 2.0);
    return wrap == TILE_WRAP_MIRROR ? coordinate - 2.0 * floor(0.5 * coordinate)
                                    : coordinate - floor(coordinate);
}

// `texel`: within a period, or one period at most beside it.
int wrapped(int texel, int size, uint wrap) {
    if (wrap != TILE_WRAP_CLAMP) {
        int period = wrap == TILE_WRAP_MIRROR ? 2 * size : size;
        texel = texel < 0 ? texel + period : texel >= period ? texel - period : texel;
        texel = texel < size ? texel : 2 * size - 1 - texel;
    }
    return clamp(texel, 0, size - 1);
}

// The tiles of the first and the last texel that interpolation at a coordinate reads.
ivec2 tiles_along(float coordinate, float within, int size, uint wrap) {
    float place = within * float(size);
    float reach = 0.5 + min(TEXEL_SLACK + 2e-6 * abs(coordinate) * float(size), float(size));
    return ivec2(wrapped(int(floor(place - reach)), size, wrap),
                 wrapped(int(floor(place + reach)), size, wrap)) >> MAP_TILE_SHIFT;
}

void mark(uint tile) {
    if (marks[tile] == 0u)
        atomicOr(marks[tile], 1u);
}

void mark_level(vec2 coordinates, vec2 within, uvec2 wrap, tile_level level) {
    ivec2 u = tiles_along(coordinates.x, within.x, int(level.width), wrap.x);
    ivec2 v = tiles_along(coordinates.y, within.y, int(level.height), wrap.y);
    uint upper = level.first_mark + uint(v.x) * level.columns;
    uint lower = level.first_mark + uint(v.y) * level.columns;
    mark(upper + uint(u.x));
    if (u.y != u.x)
        mark(upper + uint(u.y));
    if (v.y != v.x)
        mark(lower + uint(u.x));
    if (u.y != u.x && v.y != v.x)
        mark(lower + uint(u.y));
}

void mark_area(map_area area, int map) {
    float level = max(area.level - 1.0, 0.0);
    int last = int(maps[map].count) - 1;
    int finest = clamp(int(floor(level - LEVEL_SLACK)), 0, last);
    int coarsest = clamp(int(floor(level + LEVEL_SLACK)) + 1, 0, last);
    uvec2 wrap = uvec2(maps[map].wrap_u, maps[map].wrap_v);
    for (uint probe = 0u; probe < probes_of(area); ++probe) {
        vec2 coordinates = probe_position(area, probe);
        vec2 within =
            vec2(within_period(coordinates.x, wrap.x), within_period(coordinates.y, wrap.y));
        for (int i = finest; i <= coarsest; ++i)
            mark_level(coordinates, within, wrap, maps[map].levels[i]);
    }
}

void main() {
    surface_point surface = read_surface();
    for (int map = 0; map < MAP_SHADING; ++map) {
        if (maps[map].count == 0u)
            continue;
        vec2 size = vec2(maps[map].width, maps[map].height);
        if (map == MAP_NORMAL)
            mark_area(lobe_area(surface), map);
        else
            mark_area(area_of(map, size, surface), map);
    }
}
