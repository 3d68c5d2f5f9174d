#ifndef PASSES_FILTERS_KNOB_H
#define PASSES_FILTERS_KNOB_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/filter.h>

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

#endif
