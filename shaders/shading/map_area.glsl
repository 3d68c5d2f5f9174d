#ifndef MAP_AREA_GLSL
#define MAP_AREA_GLSL

// The area of a map that a pixel sees, and the probes that are spread over it.

#include "lib/map/footprint.glsl"
#include "shading/surface.glsl"

layout(constant_id = SPECIALISE_PROBES) const uint PROBES = 1; // at most
// The widths of lobes are not in their maps, see shading/colours/width_means.glsl.
layout(constant_id = SPECIALISE_WIDTHS_APART) const bool WIDTHS_APART = false;
layout(constant_id = SPECIALISE_MAGNIFIED_MAPS) const uint MAGNIFIED_MAPS = ~0u;
layout(constant_id = SPECIALISE_CLAMPED_MAPS) const uint CLAMPED_MAPS = 0;

// How much longer than the extent of its probes a footprint may be, in widths.
const float SLACK = 0.25;

// Where and over which area a map is read.
struct map_area {
    vec2 centre; // texture coordinates
    vec2 stride; // from probe to probe, along the major axis
    vec2 along;  // axes of a probe's ellipse, for an anisotropic sampler
    vec2 across;
    float level; // of the base map, at least 0; that of a round probe
    float share; // [0, 1]: of filtered levels; the rest is level 0's
    uint probes;
};

uint probes_of(map_area area) {
    return PROBES > 1u ? area.probes : 1u;
}

// As many probes as the footprint's ratio of length to width.
uint probes_needed(footprint pixel) {
    float length = pixel.major_axis / max(max(pixel.minor_axis, 1e-6 * pixel.major_axis), 1e-30);
    return uint(clamp(ceil(length - SLACK), 1.0, float(PROBES)));
}

// Whether a pixel of this draw may see level 0 of a map.
bool may_see_level_0(int map) {
    return (MAGNIFIED_MAPS & (1u << map)) != 0u;
}

// Around a point that moves by `dx` and `dy` from side to side of the pixel, in texture coordinates
// of a map. `size`: its texels. `magnified`: level 0 may be seen.
map_area area_over(vec2 centre, vec2 dx, vec2 dy, vec2 size, bool magnified) {
    footprint pixel = footprint_of(dx * size, dy * size);
    map_area area;
    area.centre = centre;
    area.probes = PROBES > 1u ? probes_needed(pixel) : 1u;
    float probes = float(probes_of(area));
    area.stride = pixel.direction * (pixel.major_axis / probes) / size;
    // The bias is a factor of the width that a sampler filters. The length must not fall below the
    // pixel's: its ends would not be seen.
    float factor = exp2(knobs.level_bias);
    area.along = max(factor, 1.0) * area.stride;
    area.across = factor * vec2(-pixel.direction.y, pixel.direction.x) * pixel.minor_axis / size;
    area.level = max(level_of(pixel, probes) + knobs.level_bias, magnified ? 0.0 : 1.0);
    area.share = min(area.level, 1.0);
    return area;
}

// The part of a pixel that lies on a clamped map, not beyond its edges. There, surfaces show the
// texels along the edge alone, whose means coarser levels do not have: they are level 0's.
float part_on_map(int map, vec2 centre, vec2 dx, vec2 dy) {
    uint clamped = CLAMPED_MAPS >> map;
    vec2 side = max(abs(dx) + abs(dy), 1e-6);
    vec2 part = (min(centre + 0.5 * side, 1.0) - max(centre - 0.5 * side, 0.0)) / side;
    part = clamp(part, 0.0, 1.0);
    return ((clamped & 1u) != 0u ? part.x : 1.0) *
           ((clamped >> MAP_COUNT & 1u) != 0u ? part.y : 1.0);
}

// `size`: texels of the base map.
map_area area_of(int map, vec2 size, surface_point surface) {
    vec2 centre = map_coordinates(map, surface.coordinates, 1.0);
    vec2 dx = map_coordinates(map, surface.coordinates_dx, 0.0);
    vec2 dy = map_coordinates(map, surface.coordinates_dy, 0.0);
    map_area area = area_over(centre, dx, dy, size, may_see_level_0(map));
    if (CLAMPED_MAPS != 0u)
        area.share *= part_on_map(map, centre, dx, dy);
    return area;
}

// The larger of the maps that lobes come from, in texels.
vec2 lobe_map_size() {
    vec2 size = vec2(1.0);
    if (has_map(MAP_NORMAL))
        size = max(size, vec2(textureSize(normal_map, 0)));
    if (has_map(MAP_WIDTH) && !WIDTHS_APART)
        size = max(size, vec2(textureSize(width_map, 0)));
    return size;
}

// The lobes' footprint uses the coordinates of the normal map, or of the width map without one.
int lobe_map() {
    return has_map(MAP_NORMAL) ? MAP_NORMAL : MAP_WIDTH;
}

map_area lobe_area(surface_point surface) {
    return area_of(lobe_map(), lobe_map_size(), surface);
}

vec2 probe_position(map_area area, uint probe) {
    return area.centre + area.stride * (float(probe) - 0.5 * float(probes_of(area) - 1u));
}

#endif
