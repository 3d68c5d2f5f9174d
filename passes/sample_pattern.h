#ifndef PASSES_SAMPLE_PATTERN_H
#define PASSES_SAMPLE_PATTERN_H

#include <stdint.h>

/// Position of sample `index` of `count` within a pixel, [0, 1) each: the Hammersley points,
/// stratified in both directions for any count, the same in every pixel and every run. One sample
/// alone is at the centre. (Hammersley 1960; van der Corput 1935.)
void sample_position(uint32_t index, uint32_t count, float position[2]);

#endif
