#include "passes/context/filter.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/parameter_averaging.h"
#include "passes/maps/tile_knobs.h"

static const filter_knob *const knobs[] = {
    &passes_knob_probes,    &passes_knob_anisotropy, &passes_knob_bias,  &passes_knob_level_blend,
    &passes_knob_curvature, &passes_knob_storage,    &passes_knob_built, NULL};

const lobe_filter passes_filter_toksvig = {
    .name = "toksvig",
    .summary = "averaged normals, whose length widens the lobes about them",
    .paper = "Toksvig 2005, Mipmapping Normal Maps",
    .shading = "toksvig",
    .shading_cost = 1.6f,
    .stretches_slopes = true,
    .knobs = knobs,
    .build = passes_parameter_averaging_build,
};
