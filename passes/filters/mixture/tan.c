#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/filters/mixture/knobs.h"
#include "passes/filters/mixture/projected_map.h"
#include "passes/filters/mixture/record.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/kept/record.h"
#include "shaders/interface/gaussian_mixture.h"

static const char *const starts[] = {"parent", "kmeans", NULL};
static const char *const formulas[] = {"repaired", "printed", NULL};

static const filter_knob start_knob = {
    .description = {.name = "start",
                    .summary = "what Gaussians are fitted from: those of the coarser level's "
                               "texel, or k-means of the texel's own normals, as printed",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = starts,
                    .sweep = "kmeans"},
    .decides_slots = true,
};
static const filter_knob prior_knob = {
    .description = {.name = "prior",
                    .summary = "how many normals the like Gaussian of a neighbour is worth",
                    .maximum = 1e6,
                    .initial = 1,
                    .sweep = "0,1000"},
};
static const filter_knob formulas_knob = {
    .description = {.name = "formulas",
                    .summary = "of variances, where the paper's are wrong",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = formulas,
                    .sweep = "printed"},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_MIXTURE_PRINTED),
    .decides_slots = true,
};
static const filter_knob *const knobs[] = {
    &passes_knob_components,
    &passes_knob_fit_steps,
    &start_knob,
    &prior_knob,
    &formulas_knob,
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
        .plane = MIXTURE_PLANE_PROJECTED,
        .start = passes_knob_choice(context, &start_knob),
        .prior = (float)passes_knob_value(context, &prior_knob),
        .shape = MIXTURE_SHAPE_ROUND,
        .is_printed = passes_knob_choice(context, &formulas_knob) > 0,
        .format = passes_filtered_map_format(context),
    };
}

static lobe_result prepare(const filter_context *context, uint32_t material, void **slot) {
    const mixture_kind kind = kind_of(context);
    return passes_mixture_prepare(context, material, &kind, slot);
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    const mixture_kind kind = kind_of(context);
    passes_projected_map_build(context, instance, &kind, prepared, appearance);
}

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    (void)scene;
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return "lobes get their mean colour";
    if (material->distribution != LOBE_DISTRIBUTION_BECKMANN)
        return "base lobes become Gaussians of equal width";
    return NULL;
}

const lobe_filter passes_filter_tan = {
    .name = "tan",
    .summary = "a mixture of round Gaussians of normals fitted under each texel",
    .paper = "Tan et al. 2005, Multiresolution Reflectance Filtering",
    .shading = "tan",
    .shading_cost = 2.6f,
    .keeps_widths = true,
    .knobs = knobs,
    .prepare = prepare,
    .adapts_to_texels = true,
    .save = passes_kept_save,
    .forget = passes_kept_forget,
    .build = build,
    .ignores = ignores,
};
