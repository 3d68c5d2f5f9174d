#ifndef MASK_GLSL
#define MASK_GLSL

// Which pixels show a masked surface: as many of them as its coverage says, the part of a pixel's
// footprint that the mask keeps. Where the map is magnified, that is all or nothing: a sharp cut.
//
// One fetch is enough for a long footprint: the pixels around stand for its other parts.

#include "lib/map/ordered_dither.glsl"
#include "shading/filtered_maps.glsl"

// How many times longer than wide a footprint may be before it is taken to be wider.
const float LONGEST_MASK = 16.0;

// In an octave of distance: layers farther apart than one part are dithered independently, so that
// they do not hide the same pixels.
const float DITHER_LAYERS = 16.0;

// In the filtered map. `level`: its own.
float filtered_coverage(surface_point surface, vec2 position, float level) {
    if (!MASK_VARIES)
        return textureLod(base_colour_filtered, position, level).a;
    vec3 layers = mask_layers_at(surface);
    return mix(textureLod(mask_layers, vec3(position, layers.x), level).a,
               textureLod(mask_layers, vec3(position, layers.y), level).a, layers.z);
}

// The mask's coverage, at one place within the footprint; `along`: where, in [0, 1].
float mask_coverage(surface_point surface, float along) {
    vec2 size = vec2(textureSize(base_colour_map, 0));
    vec2 dx = map_coordinates(MAP_BASE_COLOUR, surface.coordinates_dx, 0.0);
    vec2 dy = map_coordinates(MAP_BASE_COLOUR, surface.coordinates_dy, 0.0);
    footprint pixel = footprint_of(dx * size, dy * size);
    float width = max(pixel.minor_axis, pixel.major_axis / LONGEST_MASK);
    vec2 offset = pixel.direction * ((pixel.major_axis - width) * (along - 0.5));
    vec2 position = map_coordinates(MAP_BASE_COLOUR, surface.coordinates, 1.0) + offset / size;
    float level = log2(max(width, 1e-6)) + knobs.level_bias;
    vec4 finest = base_texel(base_colour_map, position);
    float coverage = filterable(MAP_BASE_COLOUR, finest, surface).a;
    float share = clamp(level, 0.0, 1.0);
    if (CLAMPED_MAPS != 0u)
        share *= part_on_map(MAP_BASE_COLOUR, position, dx, dy);
    return mix(coverage, filtered_coverage(surface, position, max(level - 1.0, 0.0)), share);
}

bool keeps_footprint(surface_point surface) {
    // Where even a texel of alpha 1 is cut away: filtered maps know no higher threshold.
    if (!is_kept(1.0, surface))
        return false;
    if ((FILTERED_MAPS & (1u << MAP_BASE_COLOUR)) == 0u)
        return is_kept(unfiltered_base_colour(surface).a, surface);
    uint layer = uint(int(floor(DITHER_LAYERS * log2(max(surface.depth, 1e-30)))));
    float along = ordered_dither(surface.pixel, 2u * layer);
    return mask_coverage(surface, along) >
           fract(ordered_dither(surface.pixel, 2u * layer + 1u) + surface.dither);
}

#endif
