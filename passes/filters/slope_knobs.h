#ifndef PASSES_FILTERS_SLOPE_KNOBS_H
#define PASSES_FILTERS_SLOPE_KNOBS_H

#include "passes/context/knob.h"

/// Knobs of the filters that shade a displaced surface.
extern const filter_knob passes_knob_grid, passes_knob_height;

#endif
