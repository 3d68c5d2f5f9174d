#include "passes/maps/colours/width_means.h"

#include <stdio.h>

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/base_maps.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/material.h"
#include "shaders/interface/specialisation.h"

/// Whether the pass reads the colours of metal.
static bool reads_colours(const device_material *material) {
    return material->maps[MAP_BASE_COLOUR].use && material->metallic > 0 &&
           passes_maps_share_coordinates(material, MAP_BASE_COLOUR, MAP_WIDTH);
}

static void specialise(const filter_context *context, const device_material *material,
                       const struct lobe_grid_constants *extent, specialisation_list *list) {
    const uint32_t colours = reads_colours(material) ? 1u << MAP_BASE_COLOUR : 0;
    passes_lobes_specialise(material, 1u << MAP_WIDTH | colours, list);
    const bool interpolated =
        passes_device_map_is_interpolated(material, MAP_WIDTH) ||
        (colours && passes_device_map_is_interpolated(material, MAP_BASE_COLOUR));
    passes_specialise(list, SPECIALISE_INTERPOLATED, interpolated);
    if (colours)
        passes_colour_square_specialise(material, extent, interpolated, list);
    passes_knob_specialise(context, &passes_knob_base, list);
}

reduced_map passes_width_means(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const bool colours = reads_colours(material);
    const struct lobe_grid_constants extent = {.width = material->maps[MAP_WIDTH].width,
                                               .height = material->maps[MAP_WIDTH].height};
    char name[64];
    snprintf(name, sizeof name, "widths of material %u", index);
    reduced_map map = passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_RGBA32_FLOAT,
                                                 extent.width, extent.height, WIDTH_LAYERS, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "width_means");
    passes_base_maps_read(context, material, colours || material->metallic_varies, pass);
    passes_base_colour_read(context, material, colours, pass);
    passes_reduced_map_write(&map, pass, "width_means_map", 0);
    specialisation_list list = {.graph = context->graph};
    specialise(context, material, &extent, &list);
    static const char *const shaders[] = {"maps/width_means.comp", "maps/width_means.comp"};
    passes_grid_map_make(context, &extent, shaders, &list, pass, &map);
    return map;
}
