#include "passes/maps/colours/mask_coverage.h"

#include <math.h>
#include <stdio.h>

#include "passes/upload/material_maps.h"
#include "shaders/interface/mask.h"

/// The factor by which the vertices of all meshes with the material multiply its alpha.
static float vertex_alpha(const device_scene *scene, uint32_t material) {
    const lobe_material *source = scene->materials[material].material;
    float least = INFINITY, largest = -INFINITY;
    uint32_t next = scene->materials[material].first_instance;
    while (next > 0) {
        const device_instance *instance = &scene->instances[next - 1];
        next = instance->next_of_material;
        least = fminf(least, scene->measures[instance->mesh].least_alpha);
        largest = fmaxf(largest, scene->measures[instance->mesh].largest_alpha);
    }
    // Below this, nothing is kept even where the map's alpha is 1.
    float needed = source->alpha_cutoff / source->base_colour[3];
    if (needed > least && needed < largest)
        least = needed;
    return least == largest ? least : 0.5f * (least + largest);
}

static struct mask_constants constants_of(const device_scene *scene, uint32_t index) {
    const device_material *material = &scene->materials[index];
    const device_map *map = &material->maps[MAP_BASE_COLOUR];
    return (struct mask_constants){
        .width = map->width,
        .height = map->height,
        .interpolated = !map->use->nearest,
        .repeats_u = map->use->wrap_u == LOBE_SCENE_WRAP_REPEAT,
        .repeats_v = map->use->wrap_v == LOBE_SCENE_WRAP_REPEAT,
        .alpha = material->material->base_colour[3] * vertex_alpha(scene, index),
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
