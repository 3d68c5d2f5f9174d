#include "tools/compare/error_metrics.h"

#include <math.h>
#include <stddef.h>

#include <lobe/colour.h>

#include "tools/compare/flip.h"

// ---------------------------------------------------------------------------------------------
// Checks

static bool is_finite(const float *rgb) {
    return isfinite(rgb[0]) && isfinite(rgb[1]) && isfinite(rgb[2]);
}

static lobe_result check_finite(const lobe_image *image, const char *name, const lobe_host *host) {
    const float *texels = image->texels;
    size_t count = (size_t)image->width * image->height, bad = 0, first = 0;
    for (size_t index = count; index-- > 0;) {
        if (!is_finite(texels + 4 * index)) {
            bad++;
            first = index;
        }
    }
    if (bad == 0)
        return LOBE_OK;
    lobe_host_log(host, LOBE_LOG_ERROR,
                  "%s: %zu of %zu pixels are NaN or infinite, the first at x %zu, y %zu", name, bad,
                  count, first % image->width, first / image->width);
    return LOBE_ERROR_INVALID_ARGUMENT;
}

static lobe_result check_images(const lobe_image *test, const lobe_image *reference,
                                const error_metrics_parameters *parameters, const lobe_host *host) {
    if (test->format != LOBE_FORMAT_RGBA32_FLOAT || reference->format != LOBE_FORMAT_RGBA32_FLOAT) {
        lobe_host_log(host, LOBE_LOG_ERROR, "%s and %s: only RGBA32_FLOAT images are compared",
                      parameters->test_name, parameters->reference_name);
        return LOBE_ERROR_INVALID_ARGUMENT;
    }
    if (test->width != reference->width || test->height != reference->height) {
        lobe_host_log(host, LOBE_LOG_ERROR, "sizes differ: %s is %ux%u, %s is %ux%u",
                      parameters->test_name, test->width, test->height, parameters->reference_name,
                      reference->width, reference->height);
        return LOBE_ERROR_INVALID_ARGUMENT;
    }
    lobe_result result = check_finite(test, parameters->test_name, host);
    return result == LOBE_OK ? check_finite(reference, parameters->reference_name, host) : result;
}

// ---------------------------------------------------------------------------------------------
// Sums

typedef struct error_sums {
    double count, squares, relative_squares, reference_squares;
    double absolutes, reference_absolutes, sum, reference_sum, peak;
} error_sums;

static void add(error_sums *sums, double test, double reference) {
    double difference = test - reference;
    sums->count += 1.0;
    sums->squares += difference * difference;
    sums->relative_squares += difference * difference / (reference * reference + 0.01);
    sums->reference_squares += reference * reference;
    sums->absolutes += fabs(difference);
    sums->reference_absolutes += fabs(reference);
    sums->sum += test;
    sums->reference_sum += reference;
    sums->peak = fmax(sums->peak, reference);
}

static error_sums sum_errors(const lobe_image *test, const lobe_image *reference,
                             const bool *pixels, bool linear) {
    error_sums sums = {0};
    const float *a = test->texels, *b = reference->texels;
    size_t count = (size_t)test->width * test->height;
    for (size_t index = 0; index < count; index++) {
        if (pixels != NULL && !pixels[index])
            continue;
        for (size_t channel = 4 * index; channel < 4 * index + 3; channel++) {
            if (linear)
                add(&sums, a[channel], b[channel]);
            else
                add(&sums, lobe_srgb_encode(a[channel]), lobe_srgb_encode(b[channel]));
        }
    }
    return sums;
}

/// 0 / 0, black compared with black, is no error.
static double ratio(double error, double reference) {
    return error == 0.0 ? 0.0 : error / reference;
}

/// Black is as bright as black.
static double mean_ratio(double sum, double reference) {
    return sum == reference ? 1.0 : sum / reference;
}

static void derive(const error_sums *sums, bool linear, error_metrics *metrics) {
    double mse = sums->squares / sums->count;
    double peak = linear ? sums->peak : 1.0;
    *metrics = (error_metrics){
        .rmse = sqrt(mse),
        .relative_mse = sums->relative_squares / sums->count,
        .relative_l2 = sqrt(ratio(sums->squares, sums->reference_squares)),
        .relative_l1 = ratio(sums->absolutes, sums->reference_absolutes),
        .mean_ratio = mean_ratio(sums->sum, sums->reference_sum),
        .psnr = mse == 0.0 ? INFINITY : 10.0 * log10(peak * peak / mse),
    };
}

static void clear_others(lobe_image *errors, const bool *pixels) {
    size_t count = (size_t)errors->width * errors->height;
    for (size_t index = 0; index < count; index++)
        if (!pixels[index])
            ((float *)errors->texels)[index] = 0.0f;
}

lobe_result error_metrics_measure(const lobe_image *test, const lobe_image *reference,
                                  const error_metrics_parameters *parameters, const lobe_host *host,
                                  error_metrics *metrics, lobe_image *flip_errors) {
    lobe_image errors = {0};
    if (flip_errors != NULL)
        *flip_errors = errors;
    lobe_result result = check_images(test, reference, parameters, host);
    if (result != LOBE_OK)
        return result;
    error_sums sums =
        sum_errors(test, reference, parameters->pixels, parameters->high_dynamic_range);
    derive(&sums, parameters->high_dynamic_range, metrics);
    double pixels_per_degree = parameters->pixels_per_degree > 0.0 ? parameters->pixels_per_degree
                                                                   : FLIP_PIXELS_PER_DEGREE;
    result = parameters->high_dynamic_range
                 ? flip_high_dynamic_range(test, reference, pixels_per_degree, host, &errors)
                 : flip_low_dynamic_range(test, reference, pixels_per_degree, host, &errors);
    if (result != LOBE_OK)
        return result;
    metrics->flip = flip_mean(&errors, parameters->pixels);
    if (parameters->pixels != NULL)
        clear_others(&errors, parameters->pixels);
    if (flip_errors != NULL)
        *flip_errors = errors;
    else
        lobe_image_free(&errors);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Listing

static const struct {
    const char *name;
    size_t offset;
} fields[ERROR_METRICS_COUNT] = {
    {"rmse", offsetof(error_metrics, rmse)},
    {"relative_mse", offsetof(error_metrics, relative_mse)},
    {"relative_l2", offsetof(error_metrics, relative_l2)},
    {"relative_l1", offsetof(error_metrics, relative_l1)},
    {"psnr", offsetof(error_metrics, psnr)},
    {"mean_ratio", offsetof(error_metrics, mean_ratio)},
    {"flip", offsetof(error_metrics, flip)},
};

const char *error_metrics_name(int index) {
    return fields[index].name;
}

double error_metrics_value(const error_metrics *metrics, int index) {
    return *(const double *)((const char *)metrics + fields[index].offset);
}
