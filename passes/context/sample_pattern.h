#ifndef PASSES_CONTEXT_SAMPLE_PATTERN_H
#define PASSES_CONTEXT_SAMPLE_PATTERN_H

#include <stdint.h>

/// Position of sample `index` of `count` within a pixel, [0, 1) each: the Hammersley points,
/// stratified in both directions for any count, the same in every pixel and every run. A single
/// sample is at the centre. (Hammersley 1960; van der Corput 1935.)
void passes_sample_position(uint32_t index, uint32_t count, float position[2]);

/// Number `index` of a sequence in [0, 1) of which the first 2, 4, 8, ... are spread evenly (van
/// der Corput 1935).
float passes_radical_inverse(uint32_t index);

#define SAMPLES_AROUND_CENTRE 8

/// Position of sample `index`, below SAMPLES_AROUND_CENTRE, of a pixel whose first sample is at its
/// centre, (0, 1) each: the first four and all eight make an edge's coverage most accurate.
void passes_sample_position_around_centre(uint32_t index, float position[2]);

/// Moves a position to another pattern: all positions are shifted by the same amount, wrapping
/// around the pixel's edges. Pattern 0 is not shifted. (Cranley, Patterson 1976.)
void passes_sample_position_in_pattern(uint32_t pattern, float position[2]);

/// A pseudorandom number in [0, 1) for each index, the same on every machine.
double passes_hashed_number(uint64_t index);

/// Position `index` of `count` that are spread evenly over [0, 1)^2, each moved inside its cell by
/// a hash, so that no period of a map is met at the same phase. `count`: not a multiple of 5.
void passes_spread_position(uint32_t index, uint32_t count, double position[2]);

#endif
