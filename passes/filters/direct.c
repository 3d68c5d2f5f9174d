#include "passes/context/filter.h"
#include "passes/context/shared_knobs.h"
#include "shaders/interface/knobs.h"
#include "shaders/interface/specialisation.h"

/// Off by default: this filter shows what a single sample gives.
static const filter_knob curvature_knob = {
    .description =
        {.name = "curvature",
         .summary =
             "how much of the surface's own curvature under a pixel widens its lobes; 0: none",
         .maximum = 4},
    .feeds = KNOB_FEEDS_SHARED(curvature),
    .compiles = SPECIALISE_CURVATURE,
};
static const filter_knob *const knobs[] = {&curvature_knob, &passes_knob_normal_mapping, NULL};

const lobe_filter passes_filter_direct = {
    .name = "direct",
    .summary = "one unfiltered sample of the maps: fast, and aliased",
    .paper = "",
    .shading = "direct",
    .keeps_widths = true,
    .stretches_slopes = true,
    .knobs = knobs,
    .draws_waves = true,
};
