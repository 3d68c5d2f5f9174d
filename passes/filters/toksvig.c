#include "passes/filters/filters.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/parameter_averaging.h"

static const lobe_knob *const knobs[] = {&knob_probes, &knob_bias, &knob_curvature, &knob_storage,
                                         NULL};

const lobe_filter filter_toksvig = {
    .name = "toksvig",
    .summary = "averaged normals, whose length widens the lobes about them",
    .paper = "Toksvig 2005, Mipmapping Normal Maps",
    .shading = "toksvig",
    .knobs = knobs,
    .build = parameter_averaging_build,
};
