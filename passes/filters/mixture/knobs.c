#include "passes/filters/mixture/knobs.h"

#include "shaders/interface/moment_bins.h"

const filter_knob passes_knob_components = {
    .description = {.name = "components",
                    .summary = "Gaussians that are fitted under each texel",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = MOMENT_MAXIMUM_BINS,
                    .initial = 4,
                    .sweep = "1,2,3,6"},
    .decides_slots = true,
};
const filter_knob passes_knob_fit_steps = {
    .description = {.name = "steps",
                    .summary = "steps of expectation maximisation in each level: more fit texels "
                               "better, and blend worse between them",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 16,
                    .initial = 4,
                    .sweep = "1,8"},
    .decides_slots = true,
};
