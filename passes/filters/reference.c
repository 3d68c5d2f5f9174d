#include "passes/context/filter.h"
#include "passes/context/shared_knobs.h"

static const filter_knob *const knobs[] = {&passes_knob_normal_mapping, NULL};

const lobe_filter passes_filter_reference = {
    .name = "reference",
    .summary = "the mean of many unfiltered samples: the truth, slowly",
    .paper = "",
    .shading = "direct",
    .keeps_widths = true,
    .stretches_slopes = true,
    .knobs = knobs,
    .supersamples = true,
    .draws_waves = true,
};
