#include "passes/filters/filter.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/slope_moments.h"
#include "shaders/interface/slope_moments.h"

static const char *const grids[] = {"3", "5", "7", NULL};

// How far the grid reaches, in standard deviations, and its mean error over random surfaces, views
// and lights: 2.4 %, 0.6 % and 0.3 %. (The paper's 1.8 for 5 gives 1.3 %.)
static const float reaches[] = {1.4f, 2.2f, 2.6f};

static const lobe_knob grid_knob = {
    .name = "grid",
    .summary = "slopes each way for which diffuse facets are summed up",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 2,
    .initial = 1,
    .choices = grids,
    .sweep = "3,7",
};
static const lobe_knob height_knob = {
    .name = "height",
    .summary = "scales the relief of the maps; 0: flat",
    .maximum = 4,
    .initial = 1,
};
static const lobe_knob *const knobs[] = {
    &grid_knob,
    &height_knob,
    &passes_knob_probes,
    &passes_knob_bias,
    &passes_knob_curvature,
    &passes_knob_storage,
    NULL,
};

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    passes_slope_moments_build(context, instance, prepared, appearance);
    size_t grid = (size_t)passes_filter_setting(context, "grid");
    passes_appearance_specialise(appearance, SPECIALISE_GRID, 3 + 2 * (uint32_t)grid);
    passes_appearance_specialise_number(appearance, SPECIALISE_REACH, reaches[grid]);
    passes_appearance_specialise_number(appearance, SPECIALISE_HEIGHT,
                                        (float)passes_filter_setting(context, "height"));
}

static const char *ignores(const lobe_material *material) {
    if (material->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        return "its lobes become one, as wide as they are apart, in their mean colour; they are "
               "taken to state their own masking";
    if (material->distribution == LOBE_DISTRIBUTION_GGX)
        return "a Beckmann lobe of equal width stands for GGX, whose tails are lost";
    return NULL;
}

const lobe_filter passes_filter_leadr = {
    .name = "leadr",
    .summary = "one anisotropic Beckmann lobe, masked and lit as displaced facets are",
    .paper = "Dupuy et al. 2013, Linear Efficient Antialiased Displacement and Reflectance Mapping",
    .shading = "leadr",
    .knobs = knobs,
    .build = build,
    .ignores = ignores,
};
