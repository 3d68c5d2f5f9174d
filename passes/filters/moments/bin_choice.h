#ifndef PASSES_FILTERS_MOMENTS_BIN_CHOICE_H
#define PASSES_FILTERS_MOMENTS_BIN_CHOICE_H

#include "passes/filters/moments/mixture_fit.h"

/// Where bins get their specular colour from.
typedef enum bin_colour {
    BIN_COLOUR_AUTOMATIC, ///< their own, where that serves the material better
    BIN_COLOUR_MEAN,      ///< the footprint's mean
    BIN_COLOUR_OWN,
} bin_colour;

typedef struct bin_request {
    /// Components [1, MOMENT_MAXIMUM_BINS]; 0: as many as are worth their time.
    uint32_t bins;
    bin_colour colour;
    /// The part [0, 1) of the squared error that each further fetch of a pixel has to take away to
    /// be worth its time.
    double gain;
} bin_request;

typedef struct bin_choice {
    plane_mixture mixture;
    bool own_colours;
    bool many_points; ///< two points of a texel miss what is interpolated between texels
} bin_choice;

/// Fits the mixture that serves some footprints on a material's maps best: squares of several
/// widths, and all maps from afar. If the survey has no samples, the components are all zero, and
/// their number and points are those that serve most maps. False: out of memory.
bool passes_bins_choose(const device_scene *scene, const device_material *material,
                        const lobe_survey *survey, const bin_request *request,
                        const lobe_allocator *allocator, bin_choice *choice);

#endif
