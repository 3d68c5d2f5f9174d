#ifndef TOOLS_COMPARE_H
#define TOOLS_COMPARE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tools/compare/error_metrics.h"
#include "tools/compare/image_input.h"
#include "tools/compare/silhouettes.h"

/// What `lobe compare` works on, and the pictures it makes.

#define COMPARE_MAXIMUM_TESTS 15

typedef struct compared {
    const char *path;
    image_input input;
    error_metrics metrics;  ///< of a test
    lobe_image flip_errors; ///< the same
} compared;

typedef struct compare_job {
    lobe_host host;
    const char *difference_path, *side_by_side_path, *crop_text;
    bool json;
    uint32_t part;     ///< a compare_part
    bool *part_pixels; ///< of the reference; NULL: all
    size_t part_count; ///< how many
    double exposure, pixels_per_degree, magnification;
    uint32_t zoom;
    uint32_t crop[4];                           ///< x, y, width, height; all 0: the whole image
    compared images[COMPARE_MAXIMUM_TESTS + 1]; ///< the tests, then the reference
    size_t test_count;
} compare_job;

/// Whether the part to show lies within the images; else one line in the log.
lobe_result compare_check_crop(const compare_job *job);

/// The FLIP errors of the only test, as a heat map, to `difference_path`.
lobe_result compare_write_difference(const compare_job *job);

/// All images beside each other, with FLIP errors below the tests, to `side_by_side_path`.
lobe_result compare_write_side_by_side(const compare_job *job);

#endif
