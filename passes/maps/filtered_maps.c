#include "passes/maps/filtered_maps.h"

#include <math.h>
#include <stdio.h>

#include "passes/context/knob_values.h"
#include "passes/context/sample_count.h"
#include "passes/maps/colours/colour_correlation.h"
#include "passes/maps/colours/colour_normals.h"
#include "passes/maps/colours/mask_coverage.h"
#include "passes/maps/colours/metal_means.h"
#include "passes/maps/colours/width_means.h"
#include "passes/maps/level_reduction.h"
#include "passes/maps/magnification.h"
#include "passes/maps/seen_tiles.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/knobs.h"
#include "shaders/interface/specialisation.h"

static const char *const storages[] = {"float32", "float16", NULL};

const filter_knob passes_knob_probes = {
    .description = {.name = "probes",
                    .summary = "most samples along the longer axis of a pixel's footprint; as many "
                               "as it is longer than wide",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 16,
                    .initial = 1,
                    .sweep = "2,4"},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_PROBES),
};
const filter_knob passes_knob_anisotropy = {
    .description = {.name = "anisotropy",
                    .summary = "how much longer than wide the device's own sampler may take the "
                               "area of one probe; 1: round. Its texels are the device's choice",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 16,
                    .initial = 1},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_ANISOTROPY),
    .decides_slots = true,
    .needs = "samplerAnisotropy",
};
const filter_knob passes_knob_bias = {
    .description = {.name = "bias",
                    .summary = "added to the MIP level: below 0 sharper, above 0 smoother",
                    .minimum = -2,
                    .maximum = 2,
                    .initial = -0.5},
    .feeds = KNOB_FEEDS_SHARED(level_bias),
};
const filter_knob passes_knob_level_blend = {
    .description = {.name = "level_blend",
                    .summary = "part of the way from a MIP level to the next over which both are "
                               "fetched and blended; 1: everywhere (trilinear), 0: nowhere",
                    .maximum = 1,
                    .initial = 1,
                    .sweep = "0.5,0"},
    .feeds = KNOB_FEEDS_SHARED(level_blend),
};
const filter_knob passes_knob_curvature = {
    .description =
        {.name = "curvature",
         .summary =
             "how much of the surface's own curvature under a pixel widens its lobes; 0: none",
         .maximum = 4,
         .initial = 1},
    .feeds = KNOB_FEEDS_SHARED(curvature),
    .compiles = SPECIALISE_CURVATURE,
};
const filter_knob passes_knob_storage = {
    .description = {.name = "storage",
                    .summary =
                        "format of filtered maps: float16 halves memory; for kappa below about 200",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = storages,
                    .sweep = "float16"},
};

static const char *const filtered_names[MAP_COUNT] = {
    [MAP_BASE_COLOUR] = "base_colour_filtered", [MAP_WIDTH] = "width_filtered",
    [MAP_SPECULAR] = "specular_filtered",       [MAP_EMISSIVE] = "emissive_filtered",
    [MAP_OCCLUSION] = "occlusion_filtered",
};

lobe_format passes_filtered_map_format(const filter_context *context) {
    return passes_knob_choice(context, &passes_knob_storage) == 0 ? LOBE_FORMAT_RGBA32_FLOAT
                                                                  : LOBE_FORMAT_RGBA16_FLOAT;
}

lobe_sampler passes_filtered_map_sampler(const filter_context *context,
                                         const device_material *material, uint32_t map) {
    lobe_sampler sampler = passes_device_map_sampler(material, map);
    sampler.texels = LOBE_SAMPLE_LINEAR;
    sampler.levels = LOBE_SAMPLE_LINEAR;
    sampler.maximum_anisotropy = (float)passes_knob_value(context, &passes_knob_anisotropy);
    return sampler;
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
    reduced_map reduced =
        passes_seen_image_declare(context, material, map, name, LOBE_FORMAT_RGBA16_FLOAT);
    passes_level_reduction_from(
        context->graph, &reduced,
        passes_device_map_import(context->graph, context->scene, material, map), source->width,
        source->height);
    context->images->bytes += passes_reduced_map_bytes(&reduced, LOBE_FORMAT_RGBA16_FLOAT);
    *filtered = reduced.resource;
    return reduced.resource;
}

typedef reduced_map map_maker(const filter_context *context, uint32_t material);

/// One of the maps of the scene's materials, which all instances of a material share.
static lobe_resource shared_map(const filter_context *context, uint32_t index, lobe_resource *maps,
                                map_maker *make, lobe_format format) {
    if (maps[index].version == 0) {
        const reduced_map map = make(context, index);
        context->images->bytes += passes_reduced_map_bytes(&map, format);
        maps[index] = map.resource;
    }
    return maps[index];
}

static void bind_metal_means(const filter_context *context, uint32_t index,
                             filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const uint32_t kind = passes_metal_means_of(material);
    passes_appearance_bind(
        appearance, "metal_map",
        kind == METAL_MEANS_NONE ? lobe_graph_import_texture(context->graph, context->scene->white)
                                 : shared_map(context, index, context->images->metal,
                                              passes_metal_means, LOBE_FORMAT_RGBA16_FLOAT),
        passes_filtered_map_sampler(context, material, passes_metal_means_lie_as(material)));
    passes_appearance_specialise(appearance, SPECIALISE_METAL_MEANS, kind);
}

static void bind_width_means(const filter_context *context, uint32_t index,
                             filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const bool apart = passes_widths_lie_apart(material);
    passes_appearance_bind(appearance, "width_means_map",
                           apart ? shared_map(context, index, context->images->widths,
                                              passes_width_means, LOBE_FORMAT_RGBA32_FLOAT)
                                 : lobe_graph_import_texture(context->graph, context->scene->white),
                           passes_filtered_map_sampler(context, material, MAP_WIDTH));
    passes_appearance_specialise(appearance, SPECIALISE_WIDTHS_APART, apart);
}

static void bind_colour_normals(const filter_context *context, uint32_t index,
                                filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const bool has_map = passes_has_colour_normals(context, index);
    const bool may_have_map = !context->filter->reads_heights &&
                              passes_colours_lie_like_normals(material) &&
                              (has_map || material->colours.was_open);
    passes_appearance_bind(
        appearance, "colour_normal_map",
        has_map ? shared_map(context, index, context->images->normals, passes_colour_normals,
                             LOBE_FORMAT_RGBA16_FLOAT)
                : lobe_graph_import_texture(context->graph, context->scene->white),
        passes_filtered_map_sampler(context, material, passes_lobe_grid(material).map));
    passes_appearance_bind(appearance, "correlation_block",
                           may_have_map
                               ? passes_colour_correlation(context, index)
                               : lobe_graph_import_buffer(context->graph, material->map_constants),
                           (lobe_sampler){0});
    passes_appearance_specialise(appearance, SPECIALISE_COLOUR_NORMALS, may_have_map);
}

/// Of a mask with several thresholds: in place of the filtered base colour map.
static void bind_mask_layers(const filter_context *context, uint32_t index, bool build,
                             filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const bool varies = build && passes_mask_varies(context->scene, material);
    lobe_resource map = lobe_graph_import_texture(context->graph, context->scene->white),
                  thresholds = lobe_graph_import_buffer(context->graph, material->map_constants);
    if (varies) {
        const struct mask_thresholds values = passes_mask_thresholds(context->scene, material);
        map = shared_map(context, index, context->images->masked, passes_mask_coverage,
                         LOBE_FORMAT_RGBA16_FLOAT);
        thresholds =
            lobe_graph_upload(context->graph, "thresholds of a mask", &values, sizeof values);
    }
    passes_appearance_bind(appearance, "mask_layers", map,
                           passes_filtered_map_sampler(context, material, MAP_BASE_COLOUR));
    passes_appearance_bind(appearance, "mask_block", thresholds, (lobe_sampler){0});
    passes_appearance_specialise(appearance, SPECIALISE_MASK_VARIES, varies);
}

static lobe_resource filtered_map(const filter_context *context, uint32_t index, uint32_t map) {
    const device_material *material = &context->scene->materials[index];
    if (map != MAP_BASE_COLOUR || !material->masked)
        return filtered_image(context, material, map);
    return passes_mask_varies(context->scene, material)
               ? lobe_graph_import_texture(context->graph, context->scene->white)
               : shared_map(context, index, context->images->masked, passes_mask_coverage,
                            LOBE_FORMAT_RGBA16_FLOAT);
}

/// Maps of one texel are their own mean.
static bool needs_filtering(const device_material *material, uint32_t map) {
    const device_map *source = &material->maps[map];
    if (!source->use || source->width * source->height == 1)
        return false;
    const uint32_t metal = passes_metal_means_of(material);
    if (map == MAP_BASE_COLOUR)
        return material->masked || (metal != METAL_MEANS_COLOURED && metal != METAL_MEANS_FINER);
    // The filter's own map holds the widths; the map may also hold metalness.
    return map != MAP_WIDTH || (material->metallic_varies && metal == METAL_MEANS_NONE);
}

bool passes_filtered_map_is_image(const device_material *material, uint32_t map) {
    const bool masked = map == MAP_BASE_COLOUR && material->masked;
    return filtered_names[map] && !masked && needs_filtering(material, map);
}

/// Whether a map's texels and coordinates are those of the lobes.
static bool is_like_lobes(const device_material *material, uint32_t map) {
    const lobe_grid grid = passes_lobe_grid(material);
    const device_map *own = &material->maps[map];
    return own->use && own->width == grid.width && own->height == grid.height &&
           passes_lobe_grid_shares_coordinates(material, map);
}

/// Bits of the clamped maps that surfaces leave; those of v after those of u.
static uint32_t clamped_maps(const device_material *material) {
    uint32_t bits = 0;
    for (uint32_t map = 0; map < MAP_COUNT; map++) {
        const lobe_texture_use *use = material->maps[map].use;
        if (!use || (material->inside >> map & 1))
            continue;
        bits |= (uint32_t)(use->wrap_u == LOBE_SCENE_WRAP_CLAMP) << map;
        bits |= (uint32_t)(use->wrap_v == LOBE_SCENE_WRAP_CLAMP) << (MAP_COUNT + map);
    }
    return bits;
}

/// Bits of the maps whose level 0 some pixel may see. The normal map counts with the size of the
/// lobes' grid.
/// A constant, so that the others' level 0 is not fetched. Hence the bias or the camera compiles a
/// pipeline where it crosses the limit of a map: once for each map at most while the bias grows.
static uint32_t magnified_maps(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    double probes = passes_knob_value(context, &passes_knob_probes),
           bias = passes_knob_value(context, &passes_knob_bias) +
                  log2(passes_sample_count(context).footprint);
    const uint32_t clamped = clamped_maps(material);
    uint32_t bits = (clamped | clamped >> MAP_COUNT) & ((1u << MAP_COUNT) - 1);
    for (uint32_t map = 0; map < MAP_COUNT; map++) {
        if (!material->maps[map].use)
            continue;
        uint32_t width = map == MAP_NORMAL ? grid.width : material->maps[map].width;
        uint32_t height = map == MAP_NORMAL ? grid.height : material->maps[map].height;
        if (passes_may_be_magnified(context, index, map, width, height, probes, bias))
            bits |= 1u << map;
    }
    return bits;
}

void passes_filtered_maps_build(const filter_context *context, uint32_t index,
                                filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    uint32_t filtered = 0, like_lobes = 0;
    for (uint32_t map = 0; map < MAP_COUNT; map++) {
        if (!filtered_names[map])
            continue;
        bool build = needs_filtering(material, map);
        lobe_resource resource =
            build ? filtered_map(context, index, map)
                  : lobe_graph_import_texture(context->graph, context->scene->white);
        passes_appearance_bind(appearance, filtered_names[map], resource,
                               passes_filtered_map_sampler(context, material, map));
        if (build)
            filtered |= 1u << map;
        if (is_like_lobes(material, map))
            like_lobes |= 1u << map;
    }
    passes_appearance_specialise(appearance, SPECIALISE_INTERPOLATED,
                                 passes_device_map_is_interpolated(material, MAP_NORMAL));
    passes_appearance_specialise(appearance, SPECIALISE_LIKE_LOBES, like_lobes);
    passes_appearance_specialise(appearance, SPECIALISE_MAGNIFIED_MAPS,
                                 magnified_maps(context, index));
    passes_appearance_specialise(appearance, SPECIALISE_CLAMPED_MAPS, clamped_maps(material));
    passes_appearance_specialise(appearance, SPECIALISE_FILTERED_MAPS, filtered);
    bind_mask_layers(context, index, (filtered & 1u << MAP_BASE_COLOUR) != 0, appearance);
    bind_metal_means(context, index, appearance);
    bind_width_means(context, index, appearance);
    bind_colour_normals(context, index, appearance);
}
