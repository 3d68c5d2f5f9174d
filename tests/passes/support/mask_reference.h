#ifndef TESTS_PASSES_SUPPORT_MASK_REFERENCE_H
#define TESTS_PASSES_SUPPORT_MASK_REFERENCE_H

#include <lobe/scene.h>

/// Masks by counting points, in double precision. Images are RGBA32_FLOAT.

/// Maps of a masked material: red where they are kept by most cutoffs, blue where not.
typedef enum mask_pattern {
    MASK_CHECKER, ///< squares of two texels, alpha 0 or 1
    MASK_SMOOTH,  ///< all values of alpha, of waves that repeat
    MASK_DISCS,   ///< leaves at random, with a soft edge
    MASK_PATTERN_COUNT,
} mask_pattern;

/// Aborts if memory runs out.
lobe_image mask_image(mask_pattern pattern, uint32_t width, uint32_t height);

/// How a map is read.
typedef struct mask_sampling {
    bool nearest; ///< without interpolation
    bool clamped; ///< the edge goes on beyond the map, which otherwise is repeated
} mask_sampling;

/// The mean over a rectangle of texels of colour times what is kept, and of what is kept. The
/// rectangle lies within the map.
void mask_mean(const lobe_image *image, mask_sampling sampling, double cutoff,
               const double corner[2], const double extent[2], double mean[4]);

#endif
