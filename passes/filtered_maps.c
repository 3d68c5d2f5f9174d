#include "passes/filtered_maps.h"

#include <stdio.h>

#include "passes/level_reduction.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/specialisation.h"

const char *const storage_choices[] = {"float32", "float16", NULL};

static const char *const filtered_names[MAP_COUNT] = {
    [MAP_BASE_COLOUR] = "base_colour_filtered",
    [MAP_WIDTH] = "width_filtered",
    [MAP_SPECULAR] = "specular_filtered",
    [MAP_EMISSIVE] = "emissive_filtered",
};

lobe_format filtered_map_format(const filter_context *context) {
    return filter_setting(context, "storage") == 0 ? LOBE_FORMAT_RGBA32_FLOAT
                                                   : LOBE_FORMAT_RGBA16_FLOAT;
}

lobe_sampler filtered_map_sampler(const device_material *material, uint32_t map) {
    lobe_sampler sampler = device_map_sampler(material, map);
    sampler.texels = LOBE_SAMPLE_LINEAR;
    sampler.levels = LOBE_SAMPLE_LINEAR;
    return sampler;
}

bool lobe_map_extent(const device_material *material, uint32_t *width, uint32_t *height) {
    const device_map *normal = &material->maps[MAP_NORMAL];
    const device_map *widths = &material->maps[MAP_WIDTH];
    *width = normal->width > widths->width ? normal->width : widths->width;
    *height = normal->height > widths->height ? normal->height : widths->height;
    return *width > 0;
}

/// Colours are stored in half floats: their range is small, and the base maps have eight bits.
static lobe_resource filtered_image(const filter_context *context, const device_material *material,
                                    uint32_t map) {
    const device_map *source = &material->maps[map];
    lobe_resource *filtered = &context->images->resources[source->use->image];
    if (filtered->version != 0)
        return *filtered;
    char name[64];
    snprintf(name, sizeof name, "filtered image %d", source->use->image);
    reduced_map reduced = reduced_map_declare(context->graph, name, LOBE_FORMAT_RGBA16_FLOAT,
                                              source->width, source->height, 1);
    level_reduction_from(context->graph, &reduced,
                         device_map_import(context->graph, context->scene, material, map),
                         source->width, source->height);
    context->images->bytes += reduced_map_bytes(&reduced, LOBE_FORMAT_RGBA16_FLOAT);
    *filtered = reduced.resource;
    return reduced.resource;
}

/// Maps of one texel are their own mean.
static bool needs_filtering(const device_material *material, uint32_t map) {
    const device_map *source = &material->maps[map];
    if (!source->use || source->width * source->height == 1)
        return false;
    // Widths of half-vector lobes are in the mixtures.
    return map != MAP_WIDTH || material->material->model == LOBE_MATERIAL_MICROFACET;
}

void filtered_maps_build(const filter_context *context, const device_material *material,
                         filtered_appearance *appearance) {
    uint32_t filtered = 0;
    for (uint32_t map = 0; map < MAP_COUNT; ++map) {
        if (!filtered_names[map])
            continue;
        bool build = needs_filtering(material, map);
        lobe_resource resource =
            build ? filtered_image(context, material, map)
                  : lobe_graph_import_texture(context->graph, context->scene->white);
        appearance_bind(appearance, filtered_names[map], resource,
                        filtered_map_sampler(material, map));
        if (build)
            filtered |= 1u << map;
    }
    appearance_specialise(appearance, SPECIALISE_COLOUR_MAPS, filtered);
    appearance_specialise(appearance, SPECIALISE_PROBES,
                          (uint32_t)filter_setting(context, "probes"));
    appearance_specialise_number(appearance, SPECIALISE_LEVEL_BIAS,
                                 (float)filter_setting(context, "bias"));
}
