#ifndef TESTS_PASSES_FILTERS_DISPLACED_UNSEEN_RELIEFS_H
#define TESTS_PASSES_FILTERS_DISPLACED_UNSEEN_RELIEFS_H

#include <lobe/image.h>

/// Reliefs as materials have them, by the number of a seed: a constant that is found on those of
/// one seed is shown on those of another.

enum { UNSEEN_EXTENT = 128 };

typedef struct unseen_relief {
    const char *name;
    /// RGBA32_FLOAT, heights in texels' widths in red; repeats. Sizes, slopes and what is random
    /// depend on the seed. Free with lobe_image_free.
    lobe_image (*make)(uint64_t seed);
} unseen_relief;

/// Ended by one without a name.
extern const unseen_relief unseen_reliefs[];

#endif
