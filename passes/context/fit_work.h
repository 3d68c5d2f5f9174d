#ifndef PASSES_CONTEXT_FIT_WORK_H
#define PASSES_CONTEXT_FIT_WORK_H

#include <stdbool.h>
#include <stdint.h>

/// How much a frame does for maps that are fitted to materials, which can take seconds, and what is
/// left of it.
typedef struct fit_work {
    uint32_t parts;       ///< that this frame may still do; UINT32_MAX: all
    uint32_t parts_left;  ///< of the materials so far, for later frames
    const char *cache;    ///< folder of maps that were fitted before; NULL: none
    bool saves;           ///< adds missing maps to the cache
    bool is_dry;          ///< nothing is executed: only pipelines are made
    bool reads_back;      ///< set where the frame reads back a map, to be saved
    uint32_t most_texels; ///< along a side of an image, on this device
} fit_work;

#endif
