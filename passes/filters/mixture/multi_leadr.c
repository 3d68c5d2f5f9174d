#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/mixture/mixture_map.h"
#include "passes/filters/slope_knobs.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/moment_bins.h"

static const filter_knob components_knob = {
    .description = {.name = "components",
                    .summary = "Gaussians that are fitted to the slopes under each texel",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = MOMENT_MAXIMUM_BINS,
                    .initial = 4,
                    .sweep = "1,2,6"},
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
static const filter_knob *const knobs[] = {
    &components_knob,     &steps_knob,
    &passes_knob_grid,    &passes_knob_height,
    &passes_knob_probes,  &passes_knob_anisotropy,
    &passes_knob_bias,    &passes_knob_curvature,
    &passes_knob_storage, NULL,
};

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    (void)prepared;
    const uint32_t material = context->scene->instances[instance].material;
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[material]);
    const bool varies = passes_lobe_grid_varies(&grid);
    const mixture_kind kind = {
        .components = (uint32_t)passes_knob_value(context, &components_knob),
        .steps = (uint32_t)passes_knob_value(context, &steps_knob),
        .plane = MIXTURE_PLANE_SLOPES,
        .format = passes_filtered_map_format(context),
    };
    moment_map mixture;
    if (varies)
        mixture = passes_mixture_map(context, material, &kind);
    passes_appearance_specialise(appearance, SPECIALISE_BINS, kind.components);
    passes_bin_appearance_bind(context, material, varies ? &mixture : NULL, appearance);
}

static const char *ignores(const lobe_material *material) {
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return "its lobes get their mean colour; they are assumed to include masking";
    if (material->distribution == LOBE_DISTRIBUTION_GGX)
        return "GGX becomes Beckmann lobes of equal width, without its tails";
    return NULL;
}

const lobe_filter passes_filter_multi_leadr = {
    .name = "multi_leadr",
    .summary = "several anisotropic Beckmann lobes, masked and lit as one displaced surface is",
    .paper = "after Dupuy et al. 2013, Linear Efficient Antialiased Displacement and Reflectance "
             "Mapping, and Tan et al. 2005, Multiresolution Reflectance Filtering",
    .shading = "multi_leadr",
    .slopes = FILTER_SLOPES_MASKED_AS_SLOPES,
    .knobs = knobs,
    .build = build,
    .ignores = ignores,
};
