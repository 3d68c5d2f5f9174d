#include "passes/filters/displaced/facet_colours.h"

#include <string.h>

#include "passes/context/material_specialisation.h"
#include "passes/maps/base_maps.h"
#include "passes/upload/material_maps.h"

bool passes_lies_on_relief(const device_material *material, uint32_t map) {
    const lobe_texture_use *use = material->maps[map].use;
    return !use || (passes_maps_share_coordinates(material, map, MAP_HEIGHT) &&
                    use->wrap_u == LOBE_SCENE_WRAP_REPEAT && use->wrap_v == LOBE_SCENE_WRAP_REPEAT);
}

bool passes_has_coloured_relief(const device_material *material) {
    const device_map *colours = &material->maps[MAP_BASE_COLOUR];
    const bool colours_vary = colours->use && colours->width * colours->height > 1;
    if (!passes_has_relief(material) || (!colours_vary && !material->metallic_varies) ||
        (material->model == LOBE_MATERIAL_MICROFACET && !material->metallic_varies &&
         material->metallic >= 1))
        return false;
    return passes_lies_on_relief(material, MAP_BASE_COLOUR) &&
           (!material->metallic_varies || passes_lies_on_relief(material, MAP_WIDTH));
}

bool passes_has_widths_on_relief(const device_material *material) {
    return passes_has_relief(material) && material->model == LOBE_MATERIAL_MICROFACET &&
           material->widths_vary && passes_lies_on_relief(material, MAP_WIDTH);
}

bool passes_has_emissive_relief(const device_material *material) {
    return passes_has_relief(material) && passes_material_emits(material) &&
           passes_lies_on_relief(material, MAP_EMISSIVE);
}

/// At how many points, along a side, colours are read in a facet so that none of a map is missed.
static uint32_t colour_points(const device_material *material) {
    const device_map *heights = &material->maps[MAP_HEIGHT];
    uint32_t points = 1;
    for (uint32_t i = 0; i < 2; i++) {
        const device_map *map = &material->maps[i == 0 ? MAP_BASE_COLOUR : MAP_WIDTH];
        if (!map->use || (i == 1 && !material->metallic_varies))
            continue;
        const uint32_t across = (map->width + heights->width - 1) / heights->width,
                       down = (map->height + heights->height - 1) / heights->height;
        points = across > points ? across : points;
        points = down > points ? down : points;
    }
    return points < 8 ? points : 8;
}

lobe_resource passes_facet_colours(const filter_context *context, uint32_t index,
                                   const relief *relief, const facet_window *window) {
    const device_material *material = &context->scene->materials[index];
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "facet_colours");
    passes_base_map_read(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
    passes_base_map_read(context, material, MAP_WIDTH, "width_map", pass);
    const lobe_resource colours = lobe_pass_write(
        pass, &(lobe_binding){.name = "colour_words",
                              .resource = lobe_graph_buffer(
                                  context->graph,
                                  &(lobe_buffer_description){.name = "colours of facets",
                                                             .size = passes_window_facets(window) *
                                                                     TRANSFER_COLOUR_WORDS *
                                                                     sizeof(uint32_t)})});
    specialisation_list list = {.graph = context->graph};
    passes_material_specialise(material, &list);
    struct colour_constants constants = {.width = window->width,
                                         .height = window->height,
                                         .points = colour_points(material),
                                         .metallic = material->values.metallic,
                                         .origin_x = window->x,
                                         .origin_y = window->y,
                                         .relief_width = relief->constants.width,
                                         .relief_height = relief->constants.height};
    memcpy(constants.base_colour, material->values.base_colour, sizeof constants.base_colour);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/facet_colours.comp",
                                              .threads = {passes_window_facets(window)},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = list.items,
                                              .specialisation_count = list.count});
    return colours;
}
