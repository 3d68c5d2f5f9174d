#ifndef PASSES_FILTERS_MIXTURE_KNOBS_H
#define PASSES_FILTERS_MIXTURE_KNOBS_H

#include "passes/context/knob.h"

/// Knobs of the filters that interpolate fitted mixtures.
extern const filter_knob passes_knob_components, passes_knob_fit_steps;

#endif
