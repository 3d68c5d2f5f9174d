#ifndef FILTERED_MAPS_GLSL
#define FILTERED_MAPS_GLSL

// Reading maps over a pixel's footprint. A filtered map holds levels 1 and up of its base map (its
// own level 0 has half the base map's size); level 0 is the base map itself.

#include "interface/colours/mask.h"
#include "shading/map_area.glsl"
#include "shading/unfiltered_maps.glsl"

layout(constant_id = SPECIALISE_ANISOTROPY) const uint ANISOTROPY = 1; // of a probe, at most
layout(constant_id = SPECIALISE_FILTERED_LOBES) const bool FILTERED_LOBES = false;
layout(constant_id = SPECIALISE_FILTERED_MAPS) const uint FILTERED_MAPS = 0;
layout(constant_id = SPECIALISE_LIKE_LOBES) const uint LIKE_LOBES = 0;
// Maps of lobes are sums over what a mask keeps, see maps/base_maps.glsl.
layout(constant_id = SPECIALISE_MASKED_LOBES) const bool MASKED_LOBES = false;
// Vertices make several masks of one, and mask_layers takes the place of base_colour_filtered.
layout(constant_id = SPECIALISE_MASK_VARIES) const bool MASK_VARIES = false;

layout(LOBE_DESCRIPTOR(17)) uniform sampler2D base_colour_filtered;
layout(LOBE_DESCRIPTOR(18)) uniform sampler2D width_filtered;
layout(LOBE_DESCRIPTOR(19)) uniform sampler2D specular_filtered;
layout(LOBE_DESCRIPTOR(20)) uniform sampler2D emissive_filtered;
layout(LOBE_DESCRIPTOR(21)) uniform sampler2D occlusion_filtered;
layout(LOBE_DESCRIPTOR(49)) uniform sampler2DArray mask_layers;
layout(LOBE_DESCRIPTOR(50), std140) uniform mask_block { mask_thresholds thresholds; };

// The level of a filtered map to fetch. Two levels are blended over a part of the way from one to
// the next alone; elsewhere the nearer one is enough, which takes half the fetches.
float fetched_level(map_area area) {
    float level = max(area.level - 1.0, 0.0), coarser = fract(level);
    return level - coarser +
           clamp((coarser - 0.5) / max(knobs.level_blend, 1e-3) + 0.5, 0.0, 1.0);
}

// Texels of a level, of a map of `size` texels. (lavapipe's textureSize takes the level of one of
// several pixels for all of them.)
vec2 size_of_level(ivec2 size, float level) {
    return vec2(max(size >> int(level), ivec2(1)));
}

// One probe of a filtered map; the second, of one of its layers. An anisotropic sampler takes the
// level of the ellipse's width, and spreads its own samples along the length. Gradients of texture
// coordinates fit any map's size, so that a filtered map's own level 0 is again level 1.
vec4 fetch_probe(sampler2D map, map_area area, uint probe) {
    vec2 position = probe_position(area, probe);
    return ANISOTROPY > 1u ? textureGrad(map, position, area.along, area.across)
                           : textureLod(map, position, fetched_level(area));
}

vec4 fetch_probe(sampler2DArray map, uint layer, map_area area, uint probe) {
    vec3 position = vec3(probe_position(area, probe), layer);
    return ANISOTROPY > 1u ? textureGrad(map, position, area.along, area.across)
                           : textureLod(map, position, fetched_level(area));
}

// The mean of one layer of a filtered map over the area.
vec4 filtered_layer(sampler2DArray map, map_area area, uint layer) {
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < probes_of(area); ++i)
        sum += fetch_probe(map, layer, area, i);
    return sum / float(probes_of(area));
}

// The inverse of how much a footprint's texels count.
float per_kept(float share) {
    return MASKED_LOBES ? 1.0 / max(share, 1e-6) : 1.0;
}

bool is_masked(int map) {
    return ALPHA_MASK && map == MAP_BASE_COLOUR;
}

// What the filtered map holds, from a sample of the base map. Under a mask that is what is kept,
// premultiplied, and its share (maps/mask_coverage.comp).
vec4 filterable(int map, vec4 texel, surface_point surface) {
    if (!is_masked(map))
        return texel;
    return is_kept(texel.a, surface) ? vec4(texel.rgb, 1.0) : vec4(0.0);
}

// Where between the layers of a mask the pixel's own threshold lies: layers, and the second's part.
// Of an alpha of 0 it is infinite.
vec3 mask_layers_at(surface_point surface) {
    float threshold = material.emissive.w / (material.base_colour.a * surface.colour.a);
    float place = clamp((threshold - thresholds.least) * thresholds.layers_per_alpha, 0.0,
                        thresholds.last_layer);
    float first = min(floor(place), thresholds.last_layer - 1.0);
    return vec3(first, first + 1.0, place - first);
}

// One probe of what the pixel's mask keeps.
vec4 fetch_mask_probe(map_area area, uint probe, surface_point surface) {
    vec3 layers = mask_layers_at(surface);
    return mix(fetch_probe(mask_layers, uint(layers.x), area, probe),
               fetch_probe(mask_layers, uint(layers.y), area, probe), layers.z);
}

// `lobes`: the area of the lobes' map, reused for maps with the same layout.
vec4 filtered_texel(int map, sampler2D base, sampler2D filtered, surface_point surface,
                    map_area lobes) {
    if (!has_map(map))
        return filterable(map, vec4(1.0), surface);
    if ((FILTERED_MAPS & (1u << map)) == 0u)
        return filterable(map, base_texel(base, map_coordinates(map, surface.coordinates, 1.0)),
                          surface);
    map_area area = lobes;
    if ((LIKE_LOBES & (1u << map)) == 0u)
        area = area_of(map, vec2(textureSize(base, 0)), surface);
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < probes_of(area); ++i) {
        vec4 value = MASK_VARIES && is_masked(map) ? fetch_mask_probe(area, i, surface)
                                                   : fetch_probe(filtered, area, i);
        if (may_see_level_0(map))
            value = mix(filterable(map, base_texel(base, probe_position(area, i)), surface), value,
                        area.share);
        sum += value;
    }
    return sum / float(probes_of(area));
}

// The mean colour; under a mask, that of what is kept.
vec4 filtered_base_colour(surface_point surface, map_area lobes) {
    vec4 value =
        filtered_texel(MAP_BASE_COLOUR, base_colour_map, base_colour_filtered, surface, lobes);
    return ALPHA_MASK ? vec4(value.rgb / max(value.a, 1e-6), value.a) : value;
}

vec3 filtered_emission(surface_point surface, map_area lobes) {
    return filtered_texel(MAP_EMISSIVE, emissive_map, emissive_filtered, surface, lobes).rgb;
}

// The fraction of the environment's light that reaches the footprint.
float fetch_occlusion(surface_point surface) {
    float texel = filtered_texel(MAP_OCCLUSION, occlusion_map, occlusion_filtered, surface,
                                 lobe_area(surface)).r;
    return unoccluded(texel);
}

#endif
