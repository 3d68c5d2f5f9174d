#include "scenes/builtin/random.h"

// O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
// Random Number Generation", section 6.3: PCG-XSH-RR with 64 bits of state. The increment may be
// any odd number.
static const uint64_t multiplier = 6364136223846793005u;
static const uint64_t increment = 1442695040888963407u;

random_sequence scenes_random_start(uint64_t seed) {
    random_sequence sequence = {(seed + increment) * multiplier + increment};
    return sequence;
}

uint32_t scenes_random_bits(random_sequence *sequence) {
    uint64_t state = sequence->state;
    sequence->state = state * multiplier + increment;
    uint32_t shifted = (uint32_t)(((state >> 18) ^ state) >> 27);
    uint32_t turn = (uint32_t)(state >> 59);
    return shifted >> turn | shifted << (-turn & 31);
}

double scenes_random_between(random_sequence *sequence, double low, double high) {
    return low + (high - low) * (scenes_random_bits(sequence) / 4294967296.0);
}

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering": the 32-bit PCG as a hash.
static uint32_t hash(uint32_t value) {
    uint32_t state = value * 747796405u + 2891336453u;
    uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return word >> 22 ^ word;
}

uint32_t scenes_random_lattice(uint32_t x, uint32_t y, uint32_t seed) {
    return hash(x + hash(y + hash(seed)));
}
