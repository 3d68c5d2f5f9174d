#ifndef TOOLS_COMPARE_FLIP_H
#define TOOLS_COMPARE_FLIP_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// FLIP estimates the difference that a person sees when flipping between two images. Each texel of
/// `errors` (R32_FLOAT) is in [0, 1]; the usual summary is the mean. `test` and `reference` are
/// linear RGBA32_FLOAT images of one extent without NaN; alpha is ignored. `errors` is overwritten;
/// free it with lobe_image_free. Errors: LOBE_ERROR_OUT_OF_MEMORY.

/// How large a texel appears: 0.7 m away from a screen that is 0.7 m and 3840 pixels wide, as in
/// the papers.
#define FLIP_PIXELS_PER_DEGREE         67.0206
#define FLIP_PIXELS_PER_DEGREE_MINIMUM 1.0
#define FLIP_PIXELS_PER_DEGREE_MAXIMUM 500.0

/// Andersson et al. 2020, for images as a screen shows them: values are clamped to [0, 1].
lobe_result flip_low_dynamic_range(const lobe_image *test, const lobe_image *reference,
                                   double pixels_per_degree, const lobe_host *host,
                                   lobe_image *errors);

/// Andersson et al. 2021, for radiance: the largest of the above over a range of exposures that
/// follows from the reference. Negative values count as 0.
lobe_result flip_high_dynamic_range(const lobe_image *test, const lobe_image *reference,
                                    double pixels_per_degree, const lobe_host *host,
                                    lobe_image *errors);

/// Mean of an R32_FLOAT image's texels: of those that `pixels`, row by row, names, at least one, or
/// of all if it is NULL.
double flip_mean(const lobe_image *errors, const bool *pixels);

#endif
