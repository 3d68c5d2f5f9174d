#include "tools/compare/flip_exposures.h"

#include <math.h>
#include <stdlib.h>

// Andersson, Nilsson, Shirley, Akenine-Möller, 2021, "Visualizing Errors in Rendered High Dynamic
// Range Images".

// Narkowicz, 2016, "ACES Filmic Tone Mapping Curve": x (a x + b) / (x (c x + d) + e), with x
// scaled by 0.6 as the paper on errors has it.
static const double aces[5] = {0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14};

float flip_tone_map(float radiance, float gain) {
    const float limit = 1e6f; // the curve has long reached 1, its square not yet infinity
    float x = fminf(fmaxf(radiance * gain, 0.0f), limit);
    float mapped = x * ((float)aces[0] * x + (float)aces[1]) /
                   (x * ((float)aces[2] * x + (float)aces[3]) + (float)aces[4]);
    return fminf(mapped, 1.0f);
}

/// Where the tone map reaches `target`: the positive root of a quadratic equation.
static double inverse_tone_map(double target) {
    double a = aces[0] - target * aces[2], b = aces[1] - target * aces[3], c = -target * aces[4];
    return (-b + sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

static int compare_floats(const void *left, const void *right) {
    float a = *(const float *)left, b = *(const float *)right;
    return (a > b) - (a < b);
}

/// Median of `count` sorted values; if that is 0, the median of those above 0. Otherwise an image
/// that is mostly black would need infinite exposure.
static double bright_median(const float *sorted, size_t count) {
    size_t first = 0;
    if (sorted[(count - 1) / 2] + sorted[count / 2] <= 0.0f) {
        while (first < count && sorted[first] <= 0.0f)
            first++;
    }
    size_t rest = count - first;
    return 0.5 * (sorted[first + (rest - 1) / 2] + (double)sorted[first + rest / 2]);
}

static float luminance(const float *rgb) {
    float sum = 0.0f;
    static const float weights[3] = {0.2126f, 0.7152f, 0.0722f};
    for (int channel = 0; channel < 3; channel++)
        sum += weights[channel] * fmaxf(rgb[channel], 0.0f);
    return sum;
}

lobe_result flip_choose_exposures(const lobe_image *reference, const lobe_host *host,
                                  flip_exposures *exposures) {
    // Bright values come down to 85 % of white, so that highlights can be compared, and the
    // median up to it, so that shadows can.
    const double target = 0.85, deepest = 0x1p-24;
    size_t count = (size_t)reference->width * reference->height;
    const float *texels = reference->texels;
    float *sorted = malloc(count * sizeof *sorted);
    if (sorted == NULL) {
        lobe_host_log(host, LOBE_LOG_ERROR, "FLIP: out of memory for images of %ux%u",
                      reference->width, reference->height);
        return LOBE_ERROR_OUT_OF_MEMORY;
    }
    for (size_t index = 0; index < count; index++)
        sorted[index] = luminance(texels + 4 * index);
    qsort(sorted, count, sizeof *sorted, compare_floats);
    double maximum = sorted[count - 1];
    *exposures = (flip_exposures){0.0, 0.0, 1};
    if (maximum > 0.0) {
        double median = fmax(bright_median(sorted, count), maximum * deepest);
        exposures->start = log2(inverse_tone_map(target) / maximum);
        exposures->stop = log2(inverse_tone_map(target) / median);
        exposures->count = (unsigned)fmax(2.0, ceil(exposures->stop - exposures->start));
    }
    free(sorted);
    return LOBE_OK;
}
