#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/leadr/base_lobes.h"
#include "passes/filters/mixture/knobs.h"
#include "passes/filters/mixture/record.h"
#include "passes/filters/slope_knobs.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/kept/record.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/moment_bins.h"

static const filter_knob *const knobs[] = {
    &passes_knob_components,
    &passes_knob_fit_steps,
    &passes_knob_grid,
    &passes_knob_height,
    &passes_knob_probes,
    &passes_knob_anisotropy,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_storage,
    NULL,
};

static mixture_kind kind_of(const filter_context *context) {
    return (mixture_kind){
        .components = (uint32_t)passes_knob_value(context, &passes_knob_components),
        .steps = (uint32_t)passes_knob_value(context, &passes_knob_fit_steps),
        .plane = MIXTURE_PLANE_SLOPES,
        .format = passes_filtered_map_format(context),
    };
}

static lobe_result prepare(const filter_context *context, uint32_t material, void **slot) {
    const mixture_kind kind = kind_of(context);
    return passes_mixture_prepare(context, material, &kind, slot);
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    const mixture_kind kind = kind_of(context);
    moment_map mixture;
    const bool has = passes_mixture_build(context, material, &kind, prepared, &mixture);
    passes_appearance_specialise(appearance, SPECIALISE_BINS, kind.components);
    passes_bin_appearance_bind(context, material, has ? &mixture : NULL, appearance);
    passes_base_lobes_build(context, material, true, appearance);
}

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return "its lobes get their mean colour; they are assumed to include masking";
    if (scene->environment && material->distribution == LOBE_DISTRIBUTION_GGX)
        return "with env=sampled, GGX becomes Beckmann lobes of equal width, without its tails";
    return NULL;
}

const lobe_filter passes_filter_multi_leadr = {
    .name = "multi_leadr",
    .summary = "several anisotropic Beckmann lobes, masked and lit as one displaced surface is",
    .paper = "after Dupuy et al. 2013, Linear Efficient Antialiased Displacement and Reflectance "
             "Mapping, and Tan et al. 2005, Multiresolution Reflectance Filtering",
    .shading = "multi_leadr",
    .shading_cost = 14.0f,
    .loops_for_lights = true,
    .stretches_slopes = true,
    .slopes = FILTER_SLOPES_MASKED_AS_SLOPES,
    .knobs = knobs,
    .prepare = prepare,
    .adapts_to_texels = true,
    .save = passes_kept_save,
    .forget = passes_kept_forget,
    .build = build,
    .ignores = ignores,
};
