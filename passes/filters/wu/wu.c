#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/filters/displaced/relief.h"
#include "passes/filters/wu/kept_models.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/kept/record.h"
#include "passes/maps/parameter_averaging.h"
#include "passes/upload/material_maps.h"

static const char *const ratios[] = {"sums", "printed", NULL};
static const char *const formulas[] = {"repaired", "printed", NULL};

static const filter_knob lobes_knob = {
    .description = {.name = "lobes",
                    .summary = "lobes of normals of each cell",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = WU_MAXIMUM_LOBES,
                    .initial = 6,
                    .sweep = "1"},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_WU_LOBES),
    .decides_slots = true,
};
static const filter_knob ratio_knob = {
    .description = {.name = "ratio",
                    .summary = "what scales the lobes: ratios of sums, which conserve energy, or "
                               "means of ratios, as the paper prints them",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = ratios,
                    .sweep = "printed"},
    .decides_slots = true,
};
static const filter_knob formulas_knob = {
    .description = {.name = "formulas",
                    .summary = "what lobes reflect: by the area of them that faces the viewer, or "
                               "by Eq. 5 as it is printed, without",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = formulas,
                    .sweep = "printed"},
    .decides_slots = true,
};
static const filter_knob patches_knob = {
    .description = {.name = "patches",
                    .summary = "parts of the map that are scaled on their own, along each axis",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 8,
                    .initial = 4},
    .decides_slots = true,
};
static const filter_knob angular_knob = {
    .description = {.name = "angular",
                    .summary = "the tables of scaling have the square of so many directions",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 3,
                    .maximum = 15,
                    .initial = 15},
    .decides_slots = true,
};
static const filter_knob points_knob = {
    .description = {.name = "points",
                    .summary = "points of the map from which paths of light are followed",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 64,
                    .maximum = 16384,
                    .initial = 4096},
};
static const filter_knob bounces_knob = {
    .description = {.name = "bounces",
                    .summary = "facets that a path of light meets at most; 1: no light between "
                               "facets",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 32,
                    .initial = 16},
};
static const filter_knob *const knobs[] = {
    &lobes_knob,
    &ratio_knob,
    &formulas_knob,
    &patches_knob,
    &angular_knob,
    &points_knob,
    &bounces_knob,
    &passes_knob_probes,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_storage,
    NULL,
};

static wu_kind kind_of(const filter_context *context, uint32_t index) {
    return (wu_kind){
        .lobes = (uint32_t)passes_knob_value(context, &lobes_knob),
        .angular = (uint32_t)passes_knob_value(context, &angular_knob),
        .patches = (uint32_t)passes_knob_value(context, &patches_knob),
        .points = (uint32_t)passes_knob_value(context, &points_knob),
        .bounces = (uint32_t)passes_knob_value(context, &bounces_knob),
        .printed = (passes_knob_choice(context, &ratio_knob) == 1 ? WU_PRINTED_RATIO : 0u) |
                   (passes_knob_choice(context, &formulas_knob) == 1 ? WU_PRINTED_LOBES : 0u),
        .mirrors = context->scene->materials[index].material->model == LOBE_MATERIAL_MICROFACET,
    };
}

static lobe_result prepare(const filter_context *context, uint32_t index, void **slot) {
    const wu_kind kind = kind_of(context, index);
    return passes_kept_models_prepare(context, index, &kind, slot);
}

/// false: not all of them are made yet.
static bool make_models(const filter_context *context, uint32_t index, const void *prepared,
                        wu_models *models, filtered_appearance *appearance) {
    const device_map *map = &context->scene->materials[index].maps[MAP_HEIGHT];
    const wu_kind kind = kind_of(context, index);
    if (!passes_kept_models_build(context, index, &kind, prepared, models))
        return false;
    appearance->bytes += models->bytes;
    appearance->base_texels += (uint64_t)map->width * map->height;
    return true;
}

/// What a shader that reads no relief has bound.
static wu_models no_models(const filter_context *context) {
    static const struct wu_constants none;
    const lobe_resource nothing =
        lobe_graph_upload(context->graph, "no models", &none, sizeof none);
    return (wu_models){.block = nothing, .cells = nothing, .ratios = nothing, .whole = nothing};
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    passes_parameter_averaging_build(context, instance, prepared, appearance);
    const uint32_t index = context->scene->instances[instance].material;
    wu_models models;
    const bool has_relief = passes_has_relief(&context->scene->materials[index]) &&
                            make_models(context, index, prepared, &models, appearance);
    if (!has_relief)
        models = no_models(context);
    passes_appearance_bind(appearance, "wu_block", models.block, (lobe_sampler){0});
    passes_appearance_bind(appearance, "cell_block", models.cells, (lobe_sampler){0});
    passes_appearance_bind(appearance, "ratio_block", models.ratios, (lobe_sampler){0});
    passes_appearance_bind(appearance, "whole_block", models.whole, (lobe_sampler){0});
    passes_appearance_specialise(appearance, SPECIALISE_RELIEF, has_relief);
}

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    (void)scene;
    if (!passes_has_relief(material))
        return NULL;
    return material->model == LOBE_MATERIAL_MICROFACET
               ? "what facets mirror is lost where it meets others; colours do not vary with "
                 "heights"
               : "lobes are those of its normal map, and neither masked nor shadowed by its "
                 "heights; colours do not vary with heights";
}

const lobe_filter passes_filter_wu = {
    .name = "wu",
    .summary = "light of the relief of height maps, by lobes of its normals and factors for its "
               "shadows and the light between its facets",
    .paper = "Wu et al. 2019, Accurate Appearance Preserving Prefiltering for Rendering "
             "Displacement-Mapped Surfaces",
    .shading = "wu",
    .shading_cost = 45.0f,
    .knobs = knobs,
    .reads_heights = true,
    .prepare = prepare,
    .adapts_to_texels = true,
    .save = passes_kept_save,
    .forget = passes_kept_forget,
    .build = build,
    .ignores = ignores,
};
