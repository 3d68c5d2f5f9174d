#ifndef SCENES_BUILTIN_RANDOM_H
#define SCENES_BUILTIN_RANDOM_H

#include <stdint.h>

/// Random numbers that are the same on every machine.

/// Each seed has its own sequence.
typedef struct random_sequence {
    uint64_t state;
} random_sequence;

random_sequence scenes_random_start(uint64_t seed);

/// 32 uniform bits.
uint32_t scenes_random_bits(random_sequence *sequence);

/// Uniform in [low, high), in steps of (high - low) / 2^32.
double scenes_random_between(random_sequence *sequence, double low, double high);

/// 32 bits for a lattice point, independent of any sequence.
uint32_t scenes_random_lattice(uint32_t x, uint32_t y, uint32_t seed);

#endif
