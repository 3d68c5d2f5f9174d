#ifndef PASSES_CONTEXT_KNOB_H
#define PASSES_CONTEXT_KNOB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/filter.h>

/// How a knob's value reaches the shading shader.
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

/// Initialisers of a knob's feed. Choices, and integers that bound loops, are constants: unused
/// code is compiled out, and lavapipe recompiles a shader at every draw if a uniform bounds its
/// loops. Numbers, which users drag, are uniforms: a new value compiles nothing, unless it decides
/// whether code is needed at all (`curvature`: is it 0? `bias`: does any pixel see level 0?
/// `epsilon0`: can one lobe ever suffice?), where each answer has its own pipeline.
#define KNOB_FEEDS_CONSTANT(id)                                                                    \
    { KNOB_CONSTANT, (id) }
#define KNOB_FEEDS_SHARED(member)                                                                  \
    { KNOB_SHARED_NUMBER, offsetof(struct shared_knobs, member) }
#define KNOB_FEEDS_FILTER(structure, member)                                                       \
    { KNOB_FILTER_NUMBER, offsetof(struct structure, member) + KNOB_CHECK_SIZE(structure) }

/// Largest struct of numbers, bytes. The check is 0, or does not compile.
#define KNOB_BLOCK_SIZE 128
#define KNOB_CHECK_SIZE(structure)                                                                 \
    (0 * sizeof(char[sizeof(struct structure) <= KNOB_BLOCK_SIZE ? 1 : -1]))

/// A knob, and where its value goes. C code refers to the object to read the value, so that a
/// misspelt knob does not compile.
typedef struct filter_knob {
    lobe_knob description;
    knob_feed feeds; ///< all zero: KNOB_HOST
    /// Of a number: boolean constant that is false at 0, where the code for it is left out; 0:
    /// none.
    uint32_t compiles;
    /// A choice, or one of a few whole numbers, that decides what the filter's `prepare` keeps:
    /// each has slots of its own, so that two views with different choices prepare a material once
    /// each.
    bool decides_slots;
    /// Name of the Vulkan feature without which a device only allows the default; NULL: none.
    const char *needs;
} filter_knob;

#endif
