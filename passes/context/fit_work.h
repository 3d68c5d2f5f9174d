#ifndef PASSES_CONTEXT_FIT_WORK_H
#define PASSES_CONTEXT_FIT_WORK_H

#include <stdbool.h>
#include <stdint.h>

/// What became of the maps of materials: how many are saved by now, were found in the cache, could
/// not be saved, and are not kept at all.
typedef struct fit_outcome {
    uint32_t made, found, unsaved, unkept;
} fit_outcome;

/// How much a frame does for maps that are fitted to materials, which can take seconds, and what is
/// left of it.
typedef struct fit_work {
    uint32_t parts;       ///< that this frame may still do; UINT32_MAX: all
    uint32_t parts_left;  ///< of the materials so far, for later frames
    const char *cache;    ///< folder of maps that were fitted before; NULL: none
    bool saves;           ///< adds missing maps to the cache
    bool draws_nothing;   ///< maps are made to be saved
    bool rebuilds;        ///< all maps are made again
    bool is_dry;          ///< nothing is executed: only pipelines are made
    bool reads_back;      ///< set where the frame reads back a map, to be saved
    uint32_t most_texels; ///< along a side of an image, on this device
    uint64_t free_bytes;  ///< of device memory, where maps may be loaded from the cache
    /// Which of how many shares of a map's work is done, counted from 1 on; 0 of several: those of
    /// all are in the cache, and are joined; 0 of 0: the work is not shared.
    uint32_t share, shares;
    fit_outcome outcome; ///< of the materials so far
} fit_work;

#endif
