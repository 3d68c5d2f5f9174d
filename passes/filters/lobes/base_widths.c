#include "passes/filters/lobes/base_widths.h"

#include <math.h>

/// Of u; below this it is one width.
static const double least_variance = 1e-6;

double passes_lobe_complement(const material_lobe *lobe) {
    return 1 - passes_mean_resultant_length(lobe->concentration);
}

double passes_lobe_width(const material_lobe *lobe) {
    return 1 + 0.2 * log(fmax(passes_lobe_complement(lobe), 1e-6));
}

static double mean_complement(const material_patch *source) {
    double sum = 0;
    for (size_t i = 0; i < source->count; i++)
        sum += source->lobes[i].weight * passes_lobe_complement(&source->lobes[i]);
    return sum;
}

base_widths passes_base_widths(const material_patch *source, uint32_t count) {
    double powers[3] = {0};
    for (size_t i = 0; i < source->count; i++) {
        const double u = passes_lobe_width(&source->lobes[i]);
        for (int j = 0; j < 3; j++)
            powers[j] += source->lobes[i].weight * pow(u, j + 1);
    }
    const double mean = powers[0], variance = powers[1] - mean * mean;
    if (count == 1 || !(variance > least_variance))
        return (base_widths){
            .count = 1, .complements = {mean_complement(source)}, .parts = {1}, .mean = mean};
    const double deviation = sqrt(variance);
    const double skewness =
        (powers[2] - mean * (3 * variance + mean * mean)) / (variance * deviation);
    const double root = sqrt(skewness * skewness + 4);
    base_widths widths = {.count = 2, .mean = mean, .distance = deviation * root};
    for (int k = 0; k < 2; k++) {
        const double u = mean + 0.5 * deviation * (skewness + (k == 0 ? -root : root));
        widths.complements[k] = fmin(exp(5 * (u - 1)), 1);
        widths.parts[k] = 0.5 + (k == 0 ? 0.5 : -0.5) * skewness / root;
    }
    return widths;
}
