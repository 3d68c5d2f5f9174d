#ifndef TOOLS_COMPARE_ERROR_METRICS_H
#define TOOLS_COMPARE_ERROR_METRICS_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// The error of an image relative to a reference.

/// Sums run over the R, G and B of all texels that are measured (alpha is ignored): a the test's, b
/// the reference's values, linear radiance for high dynamic range, sRGB-encoded [0, 1] otherwise.
typedef struct error_metrics {
    double rmse;         ///< sqrt(mean((a - b)^2))
    double relative_mse; ///< mean((a - b)^2 / (b^2 + 0.01)); the 0.01 keeps black finite
    double relative_l2;  ///< sqrt(sum((a - b)^2) / sum(b^2)); infinite against a black reference
    double relative_l1;  ///< sum|a - b| / sum|b|; infinite against a black reference
    double psnr;         ///< 10 log10(peak^2 / mean((a - b)^2)) decibels; infinite where equal.
                         ///< Peak: largest value of the reference for high dynamic range, else 1
    double mean_ratio; ///< sum(a) / sum(b): brighter than the reference above 1; infinite against a
                       ///< black reference
    double flip;       ///< mean FLIP error [0, 1], see tools/compare/flip.h
} error_metrics;

typedef struct error_metrics_parameters {
    const char *test_name, *reference_name; ///< for messages
    bool high_dynamic_range;
    double pixels_per_degree; ///< 0: FLIP_PIXELS_PER_DEGREE
    const bool *pixels;       ///< row by row, those measured, at least one; NULL: all
} error_metrics_parameters;

/// Compares linear RGBA32_FLOAT images. `flip_errors` (R32_FLOAT, each texel's FLIP error, 0 where
/// it is not measured) may be NULL; otherwise it is overwritten and must be freed with
/// lobe_image_free. Errors: LOBE_ERROR_INVALID_ARGUMENT (another format, differing extents, values
/// that are not finite: the message names image, count and first position),
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result error_metrics_measure(const lobe_image *test, const lobe_image *reference,
                                  const error_metrics_parameters *parameters, const lobe_host *host,
                                  error_metrics *metrics, lobe_image *flip_errors);

/// The metrics in the order they are shown.
#define ERROR_METRICS_COUNT 7
/// "rmse" and so on; `index` below ERROR_METRICS_COUNT.
const char *error_metrics_name(int index);
double error_metrics_value(const error_metrics *metrics, int index);

#endif
