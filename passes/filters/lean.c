#include "passes/context/filter.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/slope_moments.h"
#include "passes/maps/tile_knobs.h"

static const filter_knob *const knobs[] = {
    &passes_knob_probes,    &passes_knob_anisotropy, &passes_knob_bias,  &passes_knob_level_blend,
    &passes_knob_curvature, &passes_knob_storage,    &passes_knob_built, NULL};

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    (void)scene;
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES && material->lobe_count > 1)
        return "its lobes are merged into one that covers their spread, in their mean colour";
    if (material->model == LOBE_MATERIAL_MICROFACET &&
        material->distribution == LOBE_DISTRIBUTION_GGX)
        return "GGX becomes a Beckmann lobe of equal width, without its tails";
    return NULL;
}

const lobe_filter passes_filter_lean = {
    .name = "lean",
    .summary = "one anisotropic Beckmann lobe, from moments of the maps' slopes",
    .paper = "Olano, Baker 2010, LEAN Mapping",
    .shading = "lean",
    .shading_cost = 2.6f,
    .keeps_widths = true,
    .stretches_slopes = true,
    .slopes = FILTER_SLOPES_MASKED_AS_MATERIAL,
    .knobs = knobs,
    .build = passes_slope_moments_build,
    .ignores = ignores,
};
