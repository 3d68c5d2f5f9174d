#ifndef PASSES_CONTEXT_KNOB_VALUES_H
#define PASSES_CONTEXT_KNOB_VALUES_H

#include <lobe/graph.h>

#include "passes/context/filter.h"
#include "passes/context/material_specialisation.h"

/// The knob's value in this frame, or its default if the filter does not have the knob. For a
/// choice, the index.
double passes_knob_value(const filter_context *context, const filter_knob *knob);
/// The same for a choice or an integer.
uint32_t passes_knob_choice(const filter_context *context, const filter_knob *knob);

/// Whether normal maps are those of closed surfaces: the knob `normal_mapping`.
bool passes_closes_surfaces(const filter_context *context);

/// Sets the constant that a knob feeds, for passes that prepare maps.
void passes_knob_specialise(const filter_context *context, const filter_knob *knob,
                            specialisation_list *list);

/// Sets the constants that the filter's knobs feed in the shading pass.
void passes_knobs_specialise(const filter_context *context, specialisation_list *list);
/// Uploads the numbers that the filter's knobs feed and binds them to the shading pass.
void passes_knobs_bind(const filter_context *context, lobe_pass *pass);
/// Of these, only the numbers that all filters have.
void passes_shared_knobs_bind(const filter_context *context, lobe_pass *pass);

/// Knob `index` of a filter: its own, then the shared ones. NULL past the last.
const filter_knob *passes_filter_knob(const lobe_filter *filter, size_t index);

#endif
