#include "passes/maps/colours/metal_means.h"

#include <stdio.h>

#include "passes/context/material_specialisation.h"
#include "passes/maps/base_maps.h"
#include "passes/maps/seen_tiles.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/material.h"
#include "shaders/interface/specialisation.h"

uint32_t passes_metal_means_lie_as(const device_material *material) {
    return passes_widths_lie_apart(material) ? MAP_WIDTH : passes_lobe_grid(material).map;
}

/// Whether a map lies as the means do.
static bool lies_alike(const device_material *material, uint32_t map) {
    return passes_device_map_has_texels(&material->maps[map]) && passes_lobe_grid(material).use &&
           passes_maps_share_coordinates(material, map, passes_metal_means_lie_as(material));
}

/// Texels of the maps that say where it is metal.
static struct lobe_grid_constants grid_of(const filter_context *context,
                                          const device_material *material) {
    struct lobe_grid_constants grid = passes_lobe_grid_constants(context, material);
    if (passes_widths_lie_apart(material))
        grid = (struct lobe_grid_constants){.width = material->maps[MAP_WIDTH].width,
                                            .height = material->maps[MAP_WIDTH].height};
    return grid;
}

static bool colours_are_finer(const device_material *material) {
    const bool apart = passes_widths_lie_apart(material);
    const device_map *colours = &material->maps[MAP_BASE_COLOUR],
                     *widths = &material->maps[MAP_WIDTH];
    return apart ? colours->width > widths->width || colours->height > widths->height
                 : !passes_lies_under_lobes(material, MAP_BASE_COLOUR);
}

uint32_t passes_metal_means_of(const device_material *material) {
    if (!material->metallic_varies || !lies_alike(material, MAP_WIDTH))
        return METAL_MEANS_NONE;
    // Of a mask, the filtered base colour map has the colours that it keeps.
    const bool masked_apart = material->masked && passes_widths_lie_apart(material);
    if (masked_apart || !lies_alike(material, MAP_BASE_COLOUR))
        return METAL_MEANS_ALONE;
    return colours_are_finer(material) ? METAL_MEANS_FINER : METAL_MEANS_COLOURED;
}

static uint32_t larger(uint32_t a, uint32_t b) {
    return a > b ? a : b;
}

/// Texels of the map's base maps.
static struct lobe_grid_constants extent_of(const filter_context *context,
                                            const device_material *material) {
    struct lobe_grid_constants extent = grid_of(context, material);
    if (passes_metal_means_of(material) == METAL_MEANS_FINER) {
        extent.width = larger(extent.width, material->maps[MAP_BASE_COLOUR].width);
        extent.height = larger(extent.height, material->maps[MAP_BASE_COLOUR].height);
    }
    return extent;
}

/// Only tiles of maps that have the texels of the lobes are marked.
static reduced_map declare(const filter_context *context, uint32_t index, uint32_t layers) {
    const device_material *material = &context->scene->materials[index];
    const struct lobe_grid_constants extent = extent_of(context, material);
    char name[64];
    snprintf(name, sizeof name, "metal of material %u", index);
    return passes_metal_means_of(material) == METAL_MEANS_FINER || passes_widths_lie_apart(material)
               ? passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_RGBA16_FLOAT,
                                            extent.width, extent.height, layers, true)
               : passes_seen_map_declare(context, index, name, LOBE_FORMAT_RGBA16_FLOAT, layers,
                                         true);
}

reduced_map passes_metal_means(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const bool coloured = passes_metal_means_of(material) != METAL_MEANS_ALONE;
    reduced_map map =
        declare(context, index, coloured ? METAL_LAYER_COLOUR + 1 : METAL_LAYER_METAL + 1);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "metal_means");
    passes_base_map_read(context, material, MAP_WIDTH, "width_map", pass);
    passes_base_colour_read(context, material, coloured, pass);
    passes_reduced_map_write(&map, pass, "metal_map", 0);
    specialisation_list list = {.graph = context->graph};
    passes_specialise(&list, SPECIALISE_METAL_MEANS,
                      coloured ? METAL_MEANS_COLOURED : METAL_MEANS_ALONE);
    const bool masked = passes_lobes_are_masked(material) && !passes_widths_lie_apart(material);
    passes_specialise(&list, SPECIALISE_MASKED_LOBES, masked);
    passes_specialise(&list, SPECIALISE_MANY_POINTS, masked && passes_mask_cuts_texels(material));
    const bool interpolated =
        passes_device_map_is_interpolated(material, MAP_WIDTH) ||
        ((coloured || masked) && passes_device_map_is_interpolated(material, MAP_BASE_COLOUR));
    passes_specialise(&list, SPECIALISE_INTERPOLATED, interpolated);
    const struct lobe_grid_constants extent = extent_of(context, material);
    if (coloured)
        passes_colour_square_specialise(material, &extent, interpolated, &list);
    static const char *const shaders[] = {"maps/metal_means.comp",
                                          "maps/metal_means_seen_tiles.comp"};
    passes_grid_map_make(context, &extent, shaders, &list, pass, &map);
    return map;
}
