#ifndef PASSES_FILTERS_FILTERS_H
#define PASSES_FILTERS_FILTERS_H

#include "passes/filters/filter.h"

// One a file beside this one.
extern const lobe_filter passes_filter_direct;
extern const lobe_filter passes_filter_mipmap;
extern const lobe_filter passes_filter_toksvig;
extern const lobe_filter passes_filter_lean;
extern const lobe_filter passes_filter_leadr;
extern const lobe_filter passes_filter_lobes;
extern const lobe_filter passes_filter_moments;
extern const lobe_filter passes_filter_reference;

#endif
