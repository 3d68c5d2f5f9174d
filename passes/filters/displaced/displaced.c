#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/filters/displaced/facet_colours.h"
#include "passes/filters/displaced/kept_transfer.h"
#include "passes/filters/displaced/relief.h"
#include "passes/filters/displaced/transfer_map.h"
#include "passes/filters/leadr/base_lobes.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/kept/record.h"
#include "passes/maps/magnification.h"
#include "passes/maps/parameter_averaging.h"
#include "passes/upload/material_maps.h"

static const char *const orders[] = {"4", "6", "9", NULL};
static const char *const azimuths[] = {"4", "8", "16", "32", "64", NULL};
static const char *const storages[] = {"float16", "float32", NULL};

static const filter_knob order_knob = {
    .description = {.name = "order",
                    .summary = "functions of direction that light is filtered in, those in which "
                               "the map's parts differ the most",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .initial = 1,
                    .choices = orders,
                    .sweep = "4,9"},
    .decides_slots = true,
};
static const filter_knob azimuths_knob = {
    .description = {.name = "azimuths",
                    .summary = "directions in which each facet's horizon is found",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 4,
                    .initial = 2,
                    .choices = azimuths},
    .decides_slots = true,
};
static const filter_knob bounces_knob = {
    .description = {.name = "bounces",
                    .summary = "steps of light from facet to facet; what they leave out is added "
                               "evenly, so that no light is lost",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 16,
                    .initial = 8},
    .decides_slots = true,
};
static const filter_knob transfer_storage_knob = {
    .description = {.name = "transfer_storage",
                    .summary = "format of the map of transfer",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = storages},
    .decides_slots = true,
};
static const filter_knob *const knobs[] = {
    &order_knob,
    &azimuths_knob,
    &bounces_knob,
    &transfer_storage_knob,
    &passes_knob_probes,
    &passes_knob_anisotropy,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_storage,
    NULL,
};

static uint32_t order_of(const filter_context *context) {
    static const uint32_t values[] = {4, 6, TRANSFER_MAXIMUM_ORDER};
    return values[passes_knob_choice(context, &order_knob)];
}

static transfer_kind kind_of(const filter_context *context, const device_material *material) {
    return (transfer_kind){
        .order = order_of(context),
        .azimuths = 4u << (uint32_t)passes_knob_choice(context, &azimuths_knob),
        .bounces = (uint32_t)passes_knob_value(context, &bounces_knob),
        .format = passes_knob_choice(context, &transfer_storage_knob) == 0
                      ? LOBE_FORMAT_RGBA16_FLOAT
                      : LOBE_FORMAT_RGBA32_FLOAT,
        .normals = material->material->model == LOBE_MATERIAL_MICROFACET,
        .coloured = passes_has_coloured_relief(material),
        .emissive = passes_has_emissive_relief(material),
        .widths = passes_has_widths_on_relief(material),
    };
}

static lobe_result prepare(const filter_context *context, uint32_t index, void **slot) {
    const transfer_kind kind = kind_of(context, &context->scene->materials[index]);
    return passes_kept_transfer_prepare(context, index, &kind, slot);
}

/// What shading reads of a material's relief.
typedef struct drawn_relief {
    transfer_map transfer;
    relief relief; ///< if `near`
    bool near;     ///< pixels may see less than a cell
} drawn_relief;

/// false: not all of it is made yet.
static bool make_transfer(const filter_context *context, uint32_t index, const void *prepared,
                          drawn_relief *drawn, filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const transfer_kind kind = kind_of(context, material);
    transfer_map *transfer = &drawn->transfer;
    if (!passes_kept_transfer_build(context, index, &kind, prepared, drawn->near, transfer,
                                    &drawn->relief))
        return false;
    if (drawn->near)
        appearance->bytes += drawn->relief.bytes;
    appearance->bytes +=
        passes_reduced_map_bytes(&transfer->map, kind.format) +
        (kind.normals ? passes_reduced_map_bytes(&transfer->facets, kind.format) : 0);
    appearance->base_texels +=
        (uint64_t)material->maps[MAP_HEIGHT].width * material->maps[MAP_HEIGHT].height;
    if (!kind.normals) // no shader reads them
        transfer->facets.resource =
            lobe_graph_import_texture(context->graph, context->scene->white);
    return true;
}

static transfer_map no_transfer(const filter_context *context) {
    static const struct transfer_closure_constants none;
    const lobe_resource white = lobe_graph_import_texture(context->graph, context->scene->white);
    return (transfer_map){.map = {.resource = white},
                          .facets = {.resource = white},
                          .closure =
                              lobe_graph_upload(context->graph, "no transfer", &none, sizeof none)};
}

/// Whether pixels may see less than a cell of the finest level.
static bool sees_facets(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const device_map *heights = &material->maps[MAP_HEIGHT];
    return passes_has_relief(material) &&
           passes_may_be_magnified(context, index, MAP_HEIGHT, heights->width, heights->height,
                                   passes_knob_value(context, &passes_knob_probes),
                                   passes_knob_value(context, &passes_knob_bias));
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    passes_parameter_averaging_build(context, instance, prepared, appearance);
    const uint32_t index = context->scene->instances[instance].material;
    const device_material *material = &context->scene->materials[index];
    drawn_relief drawn = {.near = sees_facets(context, index)};
    const bool has_relief =
        passes_has_relief(material) && make_transfer(context, index, prepared, &drawn, appearance);
    if (!has_relief)
        drawn.transfer = no_transfer(context);
    const lobe_sampler sampler = {.texels = LOBE_SAMPLE_LINEAR,
                                  .levels = LOBE_SAMPLE_LINEAR,
                                  .maximum_anisotropy =
                                      (float)passes_knob_value(context, &passes_knob_anisotropy)};
    passes_appearance_bind(appearance, "transfer_map", drawn.transfer.map.resource, sampler);
    passes_appearance_bind(appearance, "facet_map", drawn.transfer.facets.resource, sampler);
    passes_appearance_bind(appearance, "closure_block", drawn.transfer.closure, (lobe_sampler){0});
    passes_relief_bind(has_relief && drawn.near ? &drawn.relief : NULL, context, appearance);
    passes_base_lobes_build(context, index, has_relief, appearance);
    passes_appearance_specialise(appearance, SPECIALISE_RELIEF, has_relief);
    passes_appearance_specialise(appearance, SPECIALISE_TRANSFER_ORDER, order_of(context));
    passes_appearance_specialise(appearance, SPECIALISE_TRANSFER_COLOURED,
                                 has_relief && passes_has_coloured_relief(material));
    passes_appearance_specialise(appearance, SPECIALISE_TRANSFER_EMISSION,
                                 has_relief && passes_has_emissive_relief(material));
    passes_appearance_specialise(appearance, SPECIALISE_TRANSFER_WIDTHS,
                                 has_relief && passes_has_widths_on_relief(material));
    passes_appearance_specialise(appearance, SPECIALISE_TRANSFER_MAGNIFIED,
                                 has_relief && drawn.near);
}

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    (void)scene;
    if (!passes_has_relief(material))
        return NULL;
    const bool flat_colours = !passes_lies_on_relief(material, MAP_BASE_COLOUR);
    if (material->model == LOBE_MATERIAL_MICROFACET)
        return flat_colours
                   ? "colours do not vary with heights, whose texture coordinates are other ones"
                   : NULL;
    return flat_colours
               ? "lobes are those of its normal map, and neither masked nor shadowed by its "
                 "heights; colours do not vary with heights, whose texture coordinates are other "
                 "ones"
               : "lobes are those of its normal map, and neither masked nor shadowed by its "
                 "heights";
}

const lobe_filter passes_filter_displaced = {
    .name = "displaced",
    .summary = "diffuse and mirrored light of the relief of height maps, with its shadows and the "
               "light between its facets",
    .paper = "after Wu et al. 2019, Accurate Appearance Preserving Prefiltering for Rendering "
             "Displacement-Mapped Surfaces",
    .shading = "displaced",
    .shading_cost = 20.0f,
    .knobs = knobs,
    .reads_heights = true,
    .moves_masks = true,
    .gathers_moments = true,
    .reads_albedo = true,
    .prepare = prepare,
    .adapts_to_texels = true,
    .save = passes_kept_save,
    .shares = true,
    .forget = passes_kept_forget,
    .build = build,
    .ignores = ignores,
};
