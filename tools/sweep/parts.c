#include "tools/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>

static bool has_pixel(const bool *pixels, size_t count) {
    size_t i = 0;
    while (i < count && !pixels[i])
        i++;
    return i < count;
}

lobe_result sweep_parts_find(const sweep_job *job, lobe_image *normal_depth, sweep_truth *truth) {
    float *texels = normal_depth->texels;
    const size_t count = (size_t)normal_depth->width * normal_depth->height;
    for (size_t i = 0; i < count; i++)
        texels[4 * i] = texels[4 * i + 3]; // where silhouettes_find_part expects the depth
    lobe_result result = LOBE_OK;
    for (int part = 0; result == LOBE_OK && part < COMPARE_PART_COUNT; part++) {
        bool **pixels = &truth->pixels[part];
        result = silhouettes_find_part(normal_depth, (compare_part)part, job->bench.host, pixels);
        if (*pixels && !has_pixel(*pixels, count)) {
            free(*pixels);
            *pixels = NULL;
        }
    }
    return result;
}

static lobe_result measure(const sweep_job *job, const lobe_image *image, const sweep_truth *truth,
                           compare_part part, const sweep_row *row, double *relative_l2) {
    *relative_l2 = (double)NAN;
    if (!truth->pixels[part])
        return LOBE_OK;
    error_metrics error;
    const error_metrics_parameters parameters = {.test_name = row->filter,
                                                 .reference_name = row->scene,
                                                 .high_dynamic_range = true,
                                                 .pixels = truth->pixels[part]};
    const lobe_result result =
        error_metrics_measure(image, &truth->image, &parameters, job->bench.host, &error, NULL);
    if (result == LOBE_OK)
        *relative_l2 = sweep_without_noise(error.relative_l2, truth->noise[part]);
    return result;
}

lobe_result sweep_parts_measure(const sweep_job *job, const lobe_image *image,
                                const sweep_truth *truth, sweep_row *row) {
    const lobe_result result =
        measure(job, image, truth, COMPARE_PART_INSIDE, row, &row->inside_relative_l2);
    return result == LOBE_OK ? measure(job, image, truth, COMPARE_PART_SILHOUETTES, row,
                                       &row->silhouettes_relative_l2)
                             : result;
}

void sweep_parts_free(sweep_truth *truth) {
    for (int part = 0; part < COMPARE_PART_COUNT; part++)
        free(truth->pixels[part]);
}
