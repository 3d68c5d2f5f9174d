#include "passes/filters/filters.h"

const lobe_filter filter_direct = {
    .name = "direct",
    .summary = "one unfiltered sample of the maps: fast, and aliased",
    .paper = "",
    .shading = "direct",
};
