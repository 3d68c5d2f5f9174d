#ifndef PASSES_CONTEXT_SAMPLE_COUNT_H
#define PASSES_CONTEXT_SAMPLE_COUNT_H

#include "passes/context/filter.h"

/// How many filtered samples the pixels of a frame take.
typedef struct sample_count {
    uint32_t most;   ///< 1, 2, 4 or 8
    bool everywhere; ///< in all pixels; otherwise in those that need them, and 1 in others
    /// Side of the square that a further sample stands for, pixels. The first is taken before it is
    /// known whether others follow, and stands for the whole pixel.
    float footprint;
} sample_count;

/// What the knob `samples` asks for; always one for a filter that supersamples.
sample_count passes_sample_count(const filter_context *context);

#endif
