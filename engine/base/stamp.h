#ifndef ENGINE_BASE_STAMP_H
#define ENGINE_BASE_STAMP_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/// A 64-bit digest of everything that some content was computed from: equal stamps mean equal
/// content. Compared within one process only, never stored.
typedef uint64_t engine_stamp;

#define ENGINE_STAMP_NONE ((engine_stamp)0)

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number
/// generators", Fig. 5): every input bit moves every output bit. Never returns ENGINE_STAMP_NONE.
static inline engine_stamp engine_stamp_mix(engine_stamp stamp, uint64_t value) {
    uint64_t z = (stamp ^ value) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    // Order matters: without the rotation, (a, b) and (b, a) would differ only by the seed.
    z ^= (z >> 31) ^ (stamp << 17 | stamp >> 47);
    return z ? z : 1;
}

enum { ENGINE_STAMP_LANES = 4 };

/// A round of XXH64 (Collet, "xxHash fast digest algorithm", specification, step 2): mixes less
/// than the above, in a third of the time.
static inline engine_stamp engine_stamp_round(engine_stamp lane, uint64_t word) {
    lane += word * 0xc2b2ae3d27d4eb4fu;
    return (lane << 31 | lane >> 33) * 0x9e3779b185ebca87u;
}

/// Digests as many words at once, which do not wait for each other. Returns the bytes it took.
static inline size_t engine_stamp_lanes(engine_stamp *stamp, const unsigned char *bytes,
                                        size_t size) {
    engine_stamp lanes[ENGINE_STAMP_LANES];
    uint64_t words[ENGINE_STAMP_LANES];
    size_t taken = 0;
    for (int i = 0; i < ENGINE_STAMP_LANES; i++)
        lanes[i] = engine_stamp_mix(*stamp, (uint64_t)i);
    for (; size - taken >= sizeof words; taken += sizeof words) {
        memcpy(words, bytes + taken, sizeof words);
        for (int i = 0; i < ENGINE_STAMP_LANES; i++)
            lanes[i] = engine_stamp_round(lanes[i], words[i]);
    }
    for (int i = 0; i < ENGINE_STAMP_LANES; i++)
        *stamp = engine_stamp_mix(*stamp, lanes[i]);
    return taken;
}

static inline engine_stamp engine_stamp_bytes(engine_stamp stamp, const void *data, size_t size) {
    const unsigned char *bytes = data;
    stamp = engine_stamp_mix(stamp, size);
    if (size >= 1024) {
        const size_t taken = engine_stamp_lanes(&stamp, bytes, size);
        bytes += taken;
        size -= taken;
    }
    while (size > 0) {
        uint64_t word = 0;
        size_t step = size < sizeof word ? size : sizeof word;
        memcpy(&word, bytes, step);
        stamp = engine_stamp_mix(stamp, word);
        bytes += step;
        size -= step;
    }
    return stamp;
}

static inline engine_stamp engine_stamp_text(engine_stamp stamp, const char *text) {
    return text ? engine_stamp_bytes(stamp, text, strlen(text)) : engine_stamp_mix(stamp, 0);
}

#endif
