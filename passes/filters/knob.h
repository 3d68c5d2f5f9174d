#ifndef PASSES_FILTERS_KNOB_H
#define PASSES_FILTERS_KNOB_H

#include <lobe/filter.h>
#include <lobe/graph.h>

#include "passes/renderer/material_specialisation.h"

struct filter_context;

/// What takes a knob's value to the shader that shades.
typedef enum knob_route {
    KNOB_HOST,          ///< nothing: only C reads it, with passes_knob_value
    KNOB_CONSTANT,      ///< a specialisation constant: each value has its own pipeline
    KNOB_SHARED_NUMBER, ///< a float of struct shared_knobs, which every shading shader reads
    KNOB_FILTER_NUMBER, ///< a float of the filter's own struct, `filter_knob_block` in its shader
} knob_route;

typedef struct knob_feed {
    knob_route route;
    uint32_t place; ///< identifier of the constant, or offset of the float in its struct
} knob_feed;

/// Initialisers of a knob's feed. Choices, and integers that bound loops, are constants: what is
/// not chosen is compiled out, and lavapipe compiles a shader again at each draw whose loops are
/// bounded by a uniform. Numbers, which users drag, are uniforms: another value compiles nothing.
#define KNOB_FEEDS_CONSTANT(id)                                                                    \
    { KNOB_CONSTANT, (id) }
#define KNOB_FEEDS_SHARED(member)                                                                  \
    { KNOB_SHARED_NUMBER, offsetof(struct shared_knobs, member) }
#define KNOB_FEEDS_FILTER(structure, member)                                                       \
    { KNOB_FILTER_NUMBER, offsetof(struct structure, member) }

/// A knob, and where its value goes. C code names the object to read the value, so that a knob that
/// does not exist does not compile.
typedef struct filter_knob {
    lobe_knob description;
    knob_feed feeds; ///< all zero: KNOB_HOST
} filter_knob;

/// The knob's value in this frame; its default where the filter does not have the knob. For a
/// choice the index.
double passes_knob_value(const struct filter_context *context, const filter_knob *knob);
/// The same, of a choice or an integer.
uint32_t passes_knob_choice(const struct filter_context *context, const filter_knob *knob);

/// Sets the constant that one knob feeds: for passes that prepare maps.
void passes_knob_specialise(const struct filter_context *context, const filter_knob *knob,
                            specialisation_list *list);

/// Sets the constants that the filter's knobs feed in the shading pass.
void passes_knobs_specialise(const struct filter_context *context, specialisation_list *list);
/// Uploads the numbers that the filter's knobs feed and binds them to the shading pass.
void passes_knobs_bind(const struct filter_context *context, lobe_pass *pass);

/// All knobs of a filter: its own, then the shared ones. NULL past the last.
const filter_knob *passes_filter_knob(const lobe_filter *filter, size_t index);

#endif
