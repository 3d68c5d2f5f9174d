#include "passes/maps/base_maps.h"

#include <stdio.h>

#include "passes/maps/seen_tiles.h"
#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/material.h"
#include "shaders/interface/specialisation.h"

void passes_base_map_read(const filter_context *context, const device_material *material,
                          uint32_t map, const char *name, lobe_pass *pass) {
    lobe_pass_read(pass, &(lobe_binding){.name = name,
                                         .resource = passes_device_map_import(
                                             context->graph, context->scene, material, map),
                                         .sampler = passes_device_map_sampler(material, map)});
}

void passes_base_maps_read(const filter_context *context, const device_material *material,
                           bool colours, lobe_pass *pass) {
    static const char *const names[] = {[MAP_NORMAL] = "normal_map", [MAP_WIDTH] = "width_map"};
    for (uint32_t map = MAP_NORMAL; map <= MAP_WIDTH; map++)
        passes_base_map_read(context, material, map, names[map], pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "material_block",
                                         .resource = lobe_graph_import_buffer(
                                             context->graph, colours ? material->colour_constants
                                                                     : material->map_constants)});
}

static void read_map_or_white(const filter_context *context, const device_material *material,
                              uint32_t map, const char *name, bool reads, lobe_pass *pass) {
    if (reads)
        passes_base_map_read(context, material, map, name, pass);
    else
        lobe_pass_read(pass, &(lobe_binding){.name = name,
                                             .resource = lobe_graph_import_texture(
                                                 context->graph, context->scene->white)});
}

void passes_base_colour_read(const filter_context *context, const device_material *material,
                             bool reads, lobe_pass *pass) {
    read_map_or_white(context, material, MAP_BASE_COLOUR, "base_colour_map",
                      reads || passes_lobes_are_masked(material), pass);
}

void passes_colour_maps_read(const filter_context *context, const device_material *material,
                             bool reads, lobe_pass *pass) {
    passes_base_colour_read(context, material, reads, pass);
    read_map_or_white(context, material, MAP_SPECULAR, "specular_map", reads, pass);
}

struct lobe_grid_constants passes_lobe_grid_constants(const filter_context *context,
                                                      const device_material *material) {
    const lobe_grid grid = passes_lobe_grid(material);
    struct lobe_grid_constants constants = {.width = grid.width, .height = grid.height};
    if (passes_lobes_are_masked(material)) {
        constants.alpha = passes_mask_alpha(context->scene, material);
        constants.cutoff = material->material->alpha_cutoff;
    }
    return constants;
}

static uint32_t colour_square_of(const device_map *colours) {
    uint32_t square = COLOUR_SQUARE_CLAMPS;
    square |= colours->use->wrap_u == LOBE_SCENE_WRAP_REPEAT ? COLOUR_SQUARE_REPEATS_U : 0;
    return square | (colours->use->wrap_v == LOBE_SCENE_WRAP_REPEAT ? COLOUR_SQUARE_REPEATS_V : 0);
}

void passes_colour_square_specialise(const device_material *material,
                                     const struct lobe_grid_constants *grid, bool interpolated,
                                     specialisation_list *list) {
    const device_map *colours = &material->maps[MAP_BASE_COLOUR];
    const bool square = interpolated && !passes_mask_cuts_texels(material) &&
                        passes_device_map_is_interpolated(material, MAP_BASE_COLOUR) &&
                        colours->width == grid->width && colours->height == grid->height &&
                        grid->width % 2 == 0 && grid->height % 2 == 0;
    passes_specialise(list, SPECIALISE_COLOUR_SQUARE,
                      square ? colour_square_of(colours) : COLOUR_SQUARE_NONE);
}

bool passes_base_maps_are_interpolated(const device_material *material) {
    return passes_device_map_is_interpolated(material, MAP_NORMAL) ||
           passes_device_map_is_interpolated(material, MAP_WIDTH);
}

void passes_base_maps_specialise(const device_material *material, specialisation_list *list) {
    passes_base_maps_specialise_points(material, passes_mask_cuts_texels(material), list);
}

void passes_base_maps_specialise_points(const device_material *material, bool many_points,
                                        specialisation_list *list) {
    // Without those that no map of lobes reads.
    const uint32_t apart = passes_widths_lie_apart(material) ? 1u << MAP_WIDTH : 0;
    const uint32_t unread = 1u << MAP_EMISSIVE | 1u << MAP_OCCLUSION | apart;
    passes_lobes_specialise(material, material->map_bits & ~unread, list);
    passes_specialise(list, SPECIALISE_INTERPOLATED, passes_base_maps_are_interpolated(material));
    passes_specialise(list, SPECIALISE_MASKED_LOBES, passes_lobes_are_masked(material));
    passes_specialise(list, SPECIALISE_MANY_POINTS, many_points);
}

void passes_grid_map_make(const filter_context *context, const struct lobe_grid_constants *extent,
                          const char *const shaders[2], const specialisation_list *list,
                          lobe_pass *pass, reduced_map *map) {
    lobe_dispatch dispatch = {.shader = shaders[map->tiles.version > 0],
                              .constants = extent,
                              .constants_size = sizeof *extent,
                              .specialisation = list->items,
                              .specialisation_count = list->count};
    passes_reduced_map_dispatch(map, pass, 0, 1, &dispatch);
    passes_level_reduction(context->graph, map);
}

reduced_map passes_lobe_map(const filter_context *context, uint32_t index,
                            const lobe_map_kind *kind, lobe_format format) {
    const device_material *material = &context->scene->materials[index];
    const uint32_t layers =
        kind->layers + (passes_lobes_are_masked(material) ? kind->mask_layers : 0);
    char name[64];
    snprintf(name, sizeof name, "%s of material %u", kind->content, index);
    reduced_map map =
        passes_seen_map_declare_if(context, index, name, format, layers, kind->groups);
    map.groups = kind->groups;
    map.groups_offset = kind->groups_offset;
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, kind->pass);
    passes_base_maps_read(context, material, kind->reads_factors, pass);
    passes_base_colour_read(context, material, kind->reads_base_colour, pass);
    passes_reduced_map_write(&map, pass, kind->binding, 0);
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    if (kind->read_more)
        kind->read_more(context, material, pass, &list);
    const struct lobe_grid_constants extent = passes_lobe_grid_constants(context, material);
    if (kind->reads_base_colour)
        passes_colour_square_specialise(material, &extent,
                                        passes_base_maps_are_interpolated(material), &list);
    const char *const shaders[] = {kind->shader, kind->seen_shader};
    passes_grid_map_make(context, &extent, shaders, &list, pass, &map);
    return map;
}
