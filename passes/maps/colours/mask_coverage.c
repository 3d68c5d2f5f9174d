#include "passes/maps/colours/mask_coverage.h"

#include <stdio.h>

#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/colours/mask.h"

static struct mask_constants constants_of(const device_scene *scene, uint32_t index) {
    const device_material *material = &scene->materials[index];
    const device_map *map = &material->maps[MAP_BASE_COLOUR];
    return (struct mask_constants){
        .width = map->width,
        .height = map->height,
        .interpolated = !map->use->nearest,
        .repeats_u = map->use->wrap_u == LOBE_SCENE_WRAP_REPEAT,
        .repeats_v = map->use->wrap_v == LOBE_SCENE_WRAP_REPEAT,
        .alpha = passes_mask_alpha(scene, material),
        .cutoff = material->material->alpha_cutoff,
    };
}

reduced_map passes_mask_coverage(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const struct mask_constants constants = constants_of(context->scene, index);
    char name[64];
    snprintf(name, sizeof name, "kept colours of material %u", index);
    reduced_map map = passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_RGBA16_FLOAT,
                                                 constants.width, constants.height, 1, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "mask_coverage");
    lobe_pass_read(
        pass, &(lobe_binding){.name = "base_colour_map",
                              .resource = passes_device_map_import(context->graph, context->scene,
                                                                   material, MAP_BASE_COLOUR)});
    map.resource =
        lobe_pass_write(pass, &(lobe_binding){"coverage_map", map.resource, .range = {0, 1, 0, 1}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "maps/mask_coverage.comp",
                                 .threads = {map.width, map.height, 1},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                             });
    passes_level_reduction(context->graph, &map);
    return map;
}
