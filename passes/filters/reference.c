#include "passes/context/filter.h"

const lobe_filter passes_filter_reference = {
    .name = "reference",
    .summary = "the mean of many unfiltered samples: the truth, slowly",
    .paper = "",
    .shading = "direct",
    .supersamples = true,
};
