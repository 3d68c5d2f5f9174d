#include "passes/context/filter.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/parameter_averaging.h"
#include "passes/maps/tile_knobs.h"

static const filter_knob *const knobs[] = {
    &passes_knob_probes,    &passes_knob_anisotropy, &passes_knob_bias,  &passes_knob_level_blend,
    &passes_knob_curvature, &passes_knob_storage,    &passes_knob_built, NULL};

const lobe_filter passes_filter_mipmap = {
    .name = "mipmap",
    .summary = "normals and widths averaged like colours: fast, and wrong",
    .paper = "Xu et al. 2017, section 5.2 (naive MIP-mapping)",
    .shading = "mipmap",
    .shading_cost = 1.7f,
    .keeps_widths = true,
    .stretches_slopes = true,
    .knobs = knobs,
    .build = passes_parameter_averaging_build,
};
