#include "passes/context/filter.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/leadr/base_lobes.h"
#include "passes/filters/slope_knobs.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/slope_moments.h"
#include "passes/maps/tile_knobs.h"
#include "passes/maps/waves.h"
#include "shaders/interface/slope_moments.h"

static const char *const base_planes[] = {"facets", "surface", NULL};

static const filter_knob base_plane_knob = {
    .description = {.name = "base_plane",
                    .summary = "the plane over which the roughness of base lobes is added: that of "
                               "the mean facet or, as in the paper, the surface's, and GGX as "
                               "Beckmann's lobe of equal width",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = base_planes},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_BASE_PLANE),
};
static const filter_knob *const knobs[] = {
    &passes_knob_grid,           &base_plane_knob,
    &passes_knob_height,         &passes_knob_probes,
    &passes_knob_anisotropy,     &passes_knob_bias,
    &passes_knob_level_blend,    &passes_knob_curvature,
    &passes_knob_storage,        &passes_knob_built,
    &passes_knob_normal_mapping, NULL,
};

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return "its lobes are merged into one that covers their spread, in their mean colour; they "
               "are assumed to include masking";
    if (scene->environment && material->distribution == LOBE_DISTRIBUTION_GGX)
        return "with env=sampled and normal_mapping=classic, GGX becomes a Beckmann lobe of equal "
               "width, without its tails";
    return NULL;
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    if (passes_waves_are_drawn(context, &context->scene->materials[material])) {
        passes_wave_moments_build(context, material, appearance);
        return;
    }
    passes_slope_moments_build(context, instance, prepared, appearance);
    passes_base_lobes_build(context, material, true, appearance);
}

const lobe_filter passes_filter_leadr = {
    .name = "leadr",
    .summary = "one anisotropic Beckmann lobe, masked and lit as displaced facets are",
    .paper = "Dupuy et al. 2013, Linear Efficient Antialiased Displacement and Reflectance Mapping",
    .shading = "leadr",
    .shading_cost = 3.5f,
    .stretches_slopes = true,
    .slopes = FILTER_SLOPES_MASKED_AS_SLOPES,
    .draws_waves = true,
    .knobs = knobs,
    .build = build,
    .ignores = ignores,
};
