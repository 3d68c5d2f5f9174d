#include "passes/maps/filtered_maps.h"

#include <stdio.h>
#include <string.h>

#include "passes/maps/level_reduction.h"
#include "passes/maps/magnification.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/specialisation.h"

static const char *const storages[] = {"float32", "float16", NULL};

const lobe_knob passes_knob_probes = {
    .name = "probes",
    .summary = "most samples along the longer axis of a pixel's footprint; as many as it is longer "
               "than wide",
    .kind = LOBE_KNOB_INTEGER,
    .minimum = 1,
    .maximum = 16,
    .initial = 1,
    .sweep = "2,4",
};
const lobe_knob passes_knob_bias = {
    .name = "bias",
    .summary = "added to the MIP level: below 0 sharper, above 0 smoother",
    .minimum = -2,
    .maximum = 2,
    .initial = -0.5,
};
const lobe_knob passes_knob_curvature = {
    .name = "curvature",
    .summary = "how much of the surface's own curvature under a pixel widens its lobes; 0: none",
    .maximum = 4,
    .initial = 1,
};
const lobe_knob passes_knob_storage = {
    .name = "storage",
    .summary = "format of filtered maps: float16 halves memory, for kappa below some 200",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 1,
    .choices = storages,
    .sweep = "float16",
};

static const char *const filtered_names[MAP_COUNT] = {
    [MAP_BASE_COLOUR] = "base_colour_filtered", [MAP_WIDTH] = "width_filtered",
    [MAP_SPECULAR] = "specular_filtered",       [MAP_EMISSIVE] = "emissive_filtered",
    [MAP_OCCLUSION] = "occlusion_filtered",
};

lobe_format passes_filtered_map_format(const filter_context *context) {
    return passes_filter_setting(context, "storage") == 0 ? LOBE_FORMAT_RGBA32_FLOAT
                                                          : LOBE_FORMAT_RGBA16_FLOAT;
}

lobe_sampler passes_filtered_map_sampler(const device_material *material, uint32_t map) {
    lobe_sampler sampler = passes_device_map_sampler(material, map);
    sampler.texels = LOBE_SAMPLE_LINEAR;
    sampler.levels = LOBE_SAMPLE_LINEAR;
    return sampler;
}

bool passes_lobe_map_extent(const device_material *material, uint32_t *width, uint32_t *height) {
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
    reduced_map reduced = passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_RGBA16_FLOAT,
                                                     source->width, source->height, 1);
    passes_level_reduction_from(
        context->graph, &reduced,
        passes_device_map_import(context->graph, context->scene, material, map), source->width,
        source->height);
    context->images->bytes += passes_reduced_map_bytes(&reduced, LOBE_FORMAT_RGBA16_FLOAT);
    *filtered = reduced.resource;
    return reduced.resource;
}

/// Maps of one texel are their own mean.
static bool needs_filtering(const device_material *material, uint32_t map) {
    const device_map *source = &material->maps[map];
    if (!source->use || source->width * source->height == 1)
        return false;
    // Widths are in the mixtures (or averages); what else the map may hold is metal.
    return map != MAP_WIDTH || material->metallic_varies;
}

/// Whether a map's texels and coordinates are those of the lobes' map.
static bool is_like_lobes(const device_material *material, uint32_t map) {
    uint32_t width, height;
    const lobe_texture_use *own = material->maps[map].use;
    const lobe_texture_use *lobes = material->maps[MAP_NORMAL].use ? material->maps[MAP_NORMAL].use
                                                                   : material->maps[MAP_WIDTH].use;
    return passes_lobe_map_extent(material, &width, &height) && own &&
           material->maps[map].width == width && material->maps[map].height == height &&
           own->texture_coordinates == lobes->texture_coordinates &&
           memcmp(own->transform, lobes->transform, sizeof own->transform) == 0;
}

/// Bits of the maps whose level 0 some pixel may see; the lobes' map counts with its full size.
static uint32_t magnified_maps(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    double probes = passes_filter_setting(context, "probes"),
           bias = passes_filter_setting(context, "bias");
    uint32_t bits = 0;
    for (uint32_t map = 0; map < MAP_COUNT; ++map) {
        if (!material->maps[map].use)
            continue;
        uint32_t width = material->maps[map].width, height = material->maps[map].height;
        if (map == MAP_NORMAL)
            passes_lobe_map_extent(material, &width, &height);
        if (passes_may_be_magnified(context, index, map, width, height, probes, bias))
            bits |= 1u << map;
    }
    return bits;
}

void passes_filtered_maps_build(const filter_context *context, uint32_t index,
                                filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    uint32_t filtered = 0, like_lobes = 0;
    for (uint32_t map = 0; map < MAP_COUNT; ++map) {
        if (!filtered_names[map])
            continue;
        bool build = needs_filtering(material, map);
        lobe_resource resource =
            build ? filtered_image(context, material, map)
                  : lobe_graph_import_texture(context->graph, context->scene->white);
        passes_appearance_bind(appearance, filtered_names[map], resource,
                               passes_filtered_map_sampler(material, map));
        if (build)
            filtered |= 1u << map;
        if (is_like_lobes(material, map))
            like_lobes |= 1u << map;
    }
    passes_appearance_specialise(appearance, SPECIALISE_LIKE_LOBES, like_lobes);
    passes_appearance_specialise(appearance, SPECIALISE_MAGNIFIED_MAPS,
                                 magnified_maps(context, index));
    passes_appearance_specialise(appearance, SPECIALISE_COLOUR_MAPS, filtered);
    passes_appearance_specialise(appearance, SPECIALISE_PROBES,
                                 (uint32_t)passes_filter_setting(context, "probes"));
    passes_appearance_specialise_number(appearance, SPECIALISE_LEVEL_BIAS,
                                        (float)passes_filter_setting(context, "bias"));
    passes_appearance_specialise_number(appearance, SPECIALISE_CURVATURE,
                                        (float)passes_filter_setting(context, "curvature"));
}
