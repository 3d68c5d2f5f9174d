#include "passes/filters/slope_knobs.h"

#include "shaders/interface/slope_moments.h"

static const char *const grids[] = {"3", "5", "7", NULL};

const filter_knob passes_knob_grid = {
    .description = {.name = "grid",
                    .summary = "slopes in each direction over which diffuse facets are summed",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .initial = 1,
                    .choices = grids,
                    .sweep = "3,7"},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_GRID),
};
const filter_knob passes_knob_height = {
    .description = {.name = "height",
                    .summary = "scales the relief of the maps; 0: flat",
                    .maximum = 4,
                    .initial = 1},
    .feeds = KNOB_FEEDS_FILTER(leadr_knobs, height),
};
