#include "tools/compare/silhouettes.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/// 0: background, and what no depth should be.
static double inverse_depth(const lobe_image *depth, int64_t x, int64_t y) {
    double value = ((const float *)depth->texels)[4 * (y * depth->width + x)];
    return value > 0.0 && isfinite(value) ? 1.0 / value : 0.0;
}

static bool bends(double before, double here, double after) {
    double largest = fmax(here, fmax(before, after));
    return fabs(before - 2.0 * here + after) > SILHOUETTE_BEND * largest;
}

static bool is_edge(const lobe_image *depth, int64_t x, int64_t y) {
    double here = inverse_depth(depth, x, y);
    return (x > 0 && x + 1 < depth->width &&
            bends(inverse_depth(depth, x - 1, y), here, inverse_depth(depth, x + 1, y))) ||
           (y > 0 && y + 1 < depth->height &&
            bends(inverse_depth(depth, x, y - 1), here, inverse_depth(depth, x, y + 1)));
}

/// The picture's samples are not in the middles of its pixels: an edge reaches the next one.
static void mark_around(const lobe_image *depth, int64_t x, int64_t y, bool *pixels) {
    for (int64_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < depth->height; j++)
        for (int64_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < depth->width; i++)
            pixels[j * depth->width + i] = true;
}

lobe_result silhouettes_find_part(const lobe_image *depth, compare_part part, const lobe_host *host,
                                  bool **pixels) {
    *pixels = NULL;
    if (part == COMPARE_PART_ALL)
        return LOBE_OK;
    bool *found = calloc((size_t)depth->width * depth->height, sizeof *found);
    if (found == NULL) {
        lobe_host_log(host, LOBE_LOG_ERROR, "out of memory looking for silhouettes");
        return LOBE_ERROR_OUT_OF_MEMORY;
    }
    for (int64_t y = 0; y < depth->height; y++)
        for (int64_t x = 0; x < depth->width; x++)
            if (is_edge(depth, x, y))
                mark_around(depth, x, y, found);
    for (int64_t y = 0; part == COMPARE_PART_INSIDE && y < depth->height; y++)
        for (int64_t x = 0; x < depth->width; x++) {
            bool *pixel = &found[y * depth->width + x];
            *pixel = !*pixel && inverse_depth(depth, x, y) > 0.0;
        }
    *pixels = found;
    return LOBE_OK;
}
