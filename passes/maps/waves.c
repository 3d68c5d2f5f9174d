#include "passes/maps/waves.h"

#include <stdio.h>
#include <string.h>

#include "passes/context/knob_values.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/level_reduction.h"
#include "shaders/interface/waves.h"

static const lobe_sampler sampler = {.texels = LOBE_SAMPLE_LINEAR};

bool passes_waves_are_drawn(const filter_context *context, const device_material *material) {
    return context->filter->draws_waves && material->material->waves.layers > 0;
}

static lobe_resource given_waves(const filter_context *context, const device_material *material) {
    return context->scene->given_waves[material - context->scene->materials];
}

size_t passes_waves_bind(const filter_context *context, const device_material *material,
                         lobe_binding bindings[WAVES_BINDINGS]) {
    const lobe_waves *waves = &material->material->waves;
    struct wave_constants constants = {0};
    for (uint32_t i = 0; i < waves->layers; i++)
        constants.frequency[i] = 1 / waves->lengths[i];
    memcpy(constants.rest, waves->rest, sizeof waves->rest);
    memcpy(constants.total, waves->total, sizeof waves->total);
    bindings[0] = (lobe_binding){
        .name = "wave_fields", .resource = given_waves(context, material), .sampler = sampler};
    bindings[1] = (lobe_binding){
        .name = "wave_block",
        .resource = lobe_graph_upload(context->graph, "waves", &constants, sizeof constants)};
    return WAVES_BINDINGS;
}

void passes_waves_specialise(const device_material *material, specialisation_list *list) {
    passes_specialise(list, SPECIALISE_WAVE_LAYERS, material->material->waves.layers);
    passes_specialise(list, SPECIALISE_WAVES_CHOPPY, material->material->waves.choppy);
}

// ---------------------------------------------------------------------------------------------
// Moments

static reduced_map add_moments(const filter_context *context, uint32_t index, lobe_format format) {
    const device_material *material = &context->scene->materials[index];
    const lobe_waves *waves = &material->material->waves;
    char name[64];
    snprintf(name, sizeof name, "wave moments of material %u", index);
    reduced_map map =
        passes_reduced_map_declare(context->graph, name, format, waves->size, waves->size,
                                   WAVE_MAP_LAYERS * waves->layers, true);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "wave_moments");
    lobe_pass_read(pass, &(lobe_binding){.name = "wave_fields",
                                         .resource = given_waves(context, material),
                                         .sampler = sampler});
    passes_reduced_map_write(&map, pass, "wave_moments", 0);
    const struct wave_moments_constants constants = {.size = waves->size};
    lobe_dispatch dispatch = {.shader = "maps/wave_moments.comp",
                              .constants = &constants,
                              .constants_size = sizeof constants};
    passes_reduced_map_dispatch(&map, pass, 0, waves->layers, &dispatch);
    passes_level_reduction(context->graph, &map);
    return map;
}

void passes_wave_moments_build(const filter_context *context, uint32_t index,
                               filtered_appearance *appearance) {
    const lobe_waves *waves = &context->scene->scene->materials[index].waves;
    const lobe_format format = passes_filtered_map_format(context);
    const reduced_map map = add_moments(context, index, format);
    lobe_sampler trilinear = {.texels = LOBE_SAMPLE_LINEAR,
                              .levels = LOBE_SAMPLE_LINEAR,
                              .maximum_anisotropy =
                                  (float)passes_knob_value(context, &passes_knob_anisotropy)};
    passes_appearance_bind(appearance, "wave_moments", map.resource, trilinear);
    passes_filtered_maps_build(context, index, appearance);
    appearance->bytes = passes_reduced_map_bytes(&map, format);
    appearance->base_texels = (uint64_t)waves->size * waves->size * waves->layers;
}
