#include "passes/context/digest.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
/// generators", Fig. 5): every input bit moves every output bit.
uint64_t passes_digest(uint64_t digest, uint64_t number) {
    uint64_t z = (digest ^ number) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31) ^ (digest << 17 | digest >> 47);
}

uint64_t passes_digest_bytes(uint64_t digest, const void *bytes, size_t size) {
    const unsigned char *at = bytes;
    for (size_t left = size; left > 0;) {
        uint64_t word = 0;
        const size_t step = left < sizeof word ? left : sizeof word;
        memcpy(&word, at, step);
        digest = passes_digest(digest, word);
        at += step;
        left -= step;
    }
    return digest;
}

digest_text passes_digest_print(uint64_t digest) {
    digest_text result;
    snprintf(result.text, sizeof result.text, "%016" PRIx64, digest);
    return result;
}
