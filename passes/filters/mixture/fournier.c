#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/filters/mixture/projected_map.h"
#include "passes/filters/mixture/record.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/kept/record.h"
#include "shaders/interface/gaussian_mixture.h"

/// After k-means; twice as many change errors by a thirtieth.
enum { STEPS = 4 };

static const filter_knob peaks_knob = {
    .description = {.name = "peaks",
                    .summary = "Phong peaks that are fitted to the normals under each texel",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = MIXTURE_MAXIMUM_COMPONENTS,
                    .initial = 7,
                    .sweep = "4"},
    .decides_slots = true,
};
static const filter_knob *const knobs[] = {
    &peaks_knob,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_storage,
    NULL,
};

static mixture_kind kind_of(const filter_context *context) {
    return (mixture_kind){
        .components = (uint32_t)passes_knob_value(context, &peaks_knob),
        .steps = STEPS,
        .plane = MIXTURE_PLANE_PROJECTED,
        .start = MIXTURE_START_K_MEANS,
        .shape = MIXTURE_SHAPE_ROUND,
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
    if (material->distribution != LOBE_DISTRIBUTION_BLINN_PHONG)
        return "base lobes become Phong peaks of equal width";
    return NULL;
}

const lobe_filter passes_filter_fournier = {
    .name = "fournier",
    .summary = "Phong peaks fitted under each texel, those of all texels around evaluated",
    .paper = "Fournier 1992, Normal Distribution Functions and Multiple Surfaces",
    .shading = "fournier",
    .shading_cost = 9.0f,
    .knobs = knobs,
    .fetches_for_lights = true,
    .fetches_texels = true,
    .loops_for_lights = true,
    .prepare = prepare,
    .adapts_to_texels = true,
    .save = passes_kept_save,
    .forget = passes_kept_forget,
    .build = build,
    .ignores = ignores,
};
