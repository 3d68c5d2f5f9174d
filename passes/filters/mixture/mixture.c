#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/mixture/mixture_map.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/moment_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_bins.h"

static const char *const shapes[] = {"auto", "round", "oval", NULL};
static const char *const colours[] = {"auto", "mean", "components", NULL};

static const filter_knob components_knob = {
    .description = {.name = "components",
                    .summary = "Gaussians that are fitted to the lobes under each texel",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = MOMENT_MAXIMUM_BINS,
                    .initial = 4,
                    .sweep = "1,2,3,6"},
};
static const filter_knob steps_knob = {
    .description = {.name = "steps",
                    .summary = "steps of expectation maximisation in each level: more fit texels "
                               "better, and blend worse between them",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 16,
                    .initial = 4,
                    .sweep = "1,8"},
};
static const filter_knob shape_knob = {
    .description = {.name = "shape",
                    .summary =
                        "shape of the Gaussians while lobes are shared out among them, after "
                        "which they have any; auto: whichever serves the maps better",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = shapes,
                    .sweep = "round,oval"},
};
static const filter_knob colour_knob = {
    .description = {.name = "colour",
                    .summary =
                        "the specular colour is the footprint's mean, or each component has its "
                        "own, for half as much memory again; auto: its own where a map changes it",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = colours,
                    .sweep = "mean,components"},
};
static const filter_knob *const knobs[] = {
    &components_knob,
    &steps_knob,
    &shape_knob,
    &colour_knob,
    &passes_knob_least_share,
    &passes_knob_probes,
    &passes_knob_anisotropy,
    &passes_knob_bias,
    &passes_knob_curvature,
    &passes_knob_bin_storage,
    &passes_knob_normal_mapping,
    NULL,
};

/// Whether a map makes the specular colour differ from texel to texel.
static bool colour_varies(const device_material *material) {
    const lobe_material *source = material->material;
    if (source->model != LOBE_MATERIAL_MICROFACET)
        return material->maps[MAP_SPECULAR].use != NULL;
    return source->metallic > 0 &&
           (material->maps[MAP_BASE_COLOUR].use || material->metallic_varies);
}

static bool has_own_colours(const filter_context *context, const device_material *material) {
    enum { AUTOMATIC, MEAN, OWN };
    const uint32_t choice = passes_knob_choice(context, &colour_knob);
    if (choice == MEAN || !passes_bins_may_have_colours(material))
        return false;
    return choice == OWN || colour_varies(material);
}

static moment_map build_map(const filter_context *context, uint32_t index,
                            filtered_appearance *appearance) {
    const device_material *material = &context->scene->materials[index];
    const mixture_kind kind = {
        .components = (uint32_t)passes_knob_value(context, &components_knob),
        .steps = (uint32_t)passes_knob_value(context, &steps_knob),
        .shape = passes_knob_choice(context, &shape_knob),
        .own_colours = has_own_colours(context, material),
        .format = passes_bin_format(context),
    };
    passes_bins_specialise(material, kind.components, kind.own_colours, appearance);
    return passes_mixture_map(context, index, &kind);
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    (void)prepared;
    const uint32_t material = context->scene->instances[instance].material;
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[material]);
    const bool varies = passes_lobe_grid_varies(&grid);
    moment_map mixture;
    if (varies)
        mixture = build_map(context, material, appearance);
    passes_bin_appearance_bind(context, material, varies ? &mixture : NULL, appearance);
}

const lobe_filter passes_filter_mixture = {
    .name = "mixture",
    .summary = "a mixture of Gaussians fitted to the lobes under each texel",
    .paper = "after Tan et al. 2005, Multiresolution Reflectance Filtering",
    .shading = "moments",
    .knobs = knobs,
    .fetches_for_lights = true,
    .build = build,
};
