#include "passes/maps/colours/mask_coverage.h"

#include <math.h>
#include <stdio.h>

#include "passes/upload/colours/mask_alpha.h"
#include "passes/upload/material_maps.h"

/// Of the thresholds from layer to layer: what is kept is interpolated between them.
#define LARGEST_STEP 0.05f

/// Layers of large maps together, unless that leaves fewer than LEAST_LAYERS.
#define MOST_BYTES (256u << 20)
enum { LEAST_LAYERS = 4, TEXEL_BYTES = 8 };

static float most_layers(const device_map *map) {
    // Half the size each way, and a third of that for the coarser levels.
    const float bytes = TEXEL_BYTES / 3.0f * (float)map->width * (float)map->height;
    return fmaxf((float)MOST_BYTES / bytes, LEAST_LAYERS);
}

struct mask_thresholds passes_mask_thresholds(const device_scene *scene,
                                              const device_material *material) {
    const mask_range range = passes_mask_range(scene, material);
    const float length = range.largest - range.least;
    if (!(length > 0))
        return (struct mask_thresholds){.least = range.least};
    const float most = floorf(most_layers(&material->maps[MAP_BASE_COLOUR]));
    const float last = fminf(ceilf(length / LARGEST_STEP), most - 1);
    return (struct mask_thresholds){
        .least = range.least, .layers_per_alpha = last / length, .last_layer = last};
}

bool passes_mask_varies(const device_scene *scene, const device_material *material) {
    return material->masked && passes_mask_thresholds(scene, material).last_layer > 0;
}

static struct mask_constants constants_of(const device_scene *scene,
                                          const device_material *material,
                                          const struct mask_thresholds *thresholds) {
    const device_map *map = &material->maps[MAP_BASE_COLOUR];
    return (struct mask_constants){
        .width = map->width,
        .height = map->height,
        .interpolated = !map->use->nearest,
        .repeats_u = map->use->wrap_u == LOBE_SCENE_WRAP_REPEAT,
        .repeats_v = map->use->wrap_v == LOBE_SCENE_WRAP_REPEAT,
        .alpha = passes_mask_alpha(scene, material),
        .cutoff = material->material->alpha_cutoff,
        .step = thresholds->last_layer > 0 ? 1 / thresholds->layers_per_alpha : 0,
    };
}

reduced_map passes_mask_coverage(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const struct mask_thresholds thresholds = passes_mask_thresholds(context->scene, material);
    const struct mask_constants constants = constants_of(context->scene, material, &thresholds);
    const uint32_t layers = 1 + (uint32_t)thresholds.last_layer;
    char name[64];
    snprintf(name, sizeof name, "kept colours of material %u", index);
    reduced_map map = passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_RGBA16_FLOAT,
                                                 constants.width, constants.height, layers, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "mask_coverage");
    lobe_pass_read(
        pass, &(lobe_binding){.name = "base_colour_map",
                              .resource = passes_device_map_import(context->graph, context->scene,
                                                                   material, MAP_BASE_COLOUR)});
    map.resource = lobe_pass_write(
        pass, &(lobe_binding){"coverage_map", map.resource, .range = {0, 1, 0, layers}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "maps/mask_coverage.comp",
                                 .threads = {map.width, map.height, layers},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                             });
    passes_level_reduction(context->graph, &map);
    return map;
}
