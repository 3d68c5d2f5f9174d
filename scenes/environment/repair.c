#include "scenes/environment/repair.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "scenes/environment/direction.h"

typedef struct environment_faults {
    size_t negative, not_a_number, infinite;
} environment_faults;

// The rows around the current one, as they were before the repair: repaired texels do not count.
typedef struct repair {
    lobe_environment *environment;
    float *above, *current;
    uint32_t face[2]; // the extent of a face; neighbours beyond it do not count
    environment_faults faults;
} repair;

static float *row_of(const repair *work, uint32_t y) {
    const lobe_image *image = &work->environment->image;
    return (float *)image->texels + 4 * (size_t)y * image->width;
}

static void count_faults(environment_faults *faults, const float texel[3]) {
    bool negative = false, not_a_number = false, infinite = false;
    for (int i = 0; i < 3; i++) {
        negative |= texel[i] < 0 && !isinf(texel[i]);
        not_a_number |= isnan(texel[i]);
        infinite |= isinf(texel[i]);
    }
    faults->negative += negative;
    faults->not_a_number += not_a_number;
    faults->infinite += infinite;
}

static float mean_of_neighbours(const float *const rows[3], uint32_t left, uint32_t x,
                                uint32_t right, int component) {
    double sum = 0;
    int count = 0;
    for (int k = 0; k < 3; k++) {
        for (uint32_t i = x > left ? x - 1 : x; rows[k] && i <= x + 1 && i < right; i++) {
            const float value = rows[k][4 * (size_t)i + component];
            if (!isfinite(value))
                continue;
            sum += value > 0 ? value : 0;
            count++;
        }
    }
    return count > 0 ? (float)(sum / count) : 0;
}

static bool is_good(const float texel[3]) {
    for (int i = 0; i < 3; i++) {
        if (!(texel[i] >= 0) || isinf(texel[i]))
            return false;
    }
    return true;
}

static void mend_texel(repair *work, const float *const rows[3], uint32_t x, float *texel) {
    const uint32_t left = x - x % work->face[0];
    count_faults(&work->faults, texel);
    for (int i = 0; i < 3; i++) {
        if (!isfinite(texel[i]))
            texel[i] = mean_of_neighbours(rows, left, x, left + work->face[0], i);
        else if (texel[i] < 0)
            texel[i] = 0;
    }
}

static void mend_row(repair *work, uint32_t y) {
    const lobe_image *image = &work->environment->image;
    float *row = row_of(work, y);
    memcpy(work->current, row, 4 * sizeof *row * image->width);
    const uint32_t top = y - y % work->face[1];
    const bool last = y + 1 == top + work->face[1];
    const float *const rows[3] = {y > top ? work->above : NULL, work->current,
                                  last ? NULL : row_of(work, y + 1)};
    for (uint32_t x = 0; x < image->width; x++) {
        float *texel = row + 4 * (size_t)x;
        if (!is_good(texel))
            mend_texel(work, rows, x, texel);
        texel[3] = 1;
    }
    float *kept = work->above;
    work->above = work->current;
    work->current = kept;
}

// Repairs of the empty parts of a cross are not reported.
static void clear_empty_parts(repair *work) {
    const lobe_environment *environment = work->environment;
    const lobe_image *image = &environment->image;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x += work->face[0]) {
            double direction[3];
            if (!scenes_environment_direction(environment->layout, image->width, image->height,
                                              (double[2]){x + 0.5, y + 0.5}, direction))
                memset(row_of(work, y) + 4 * (size_t)x, 0, 4 * sizeof(float) * work->face[0]);
        }
    }
}

static void report(const repair *work, const lobe_host *host) {
    const environment_faults *faults = &work->faults;
    if (faults->negative > 0 || faults->not_a_number > 0 || faults->infinite > 0)
        lobe_host_log(host, LOBE_LOG_WARNING,
                      "%s: repaired texels with impossible radiance: %zu negative, %zu NaN, "
                      "%zu infinite",
                      work->environment->name, faults->negative, faults->not_a_number,
                      faults->infinite);
}

lobe_result scenes_environment_repair(lobe_environment *environment, const lobe_host *host) {
    const lobe_image *image = &environment->image;
    repair work = {.environment = environment};
    uint32_t grid[2];
    scenes_environment_grid(environment->layout, grid);
    work.face[0] = image->width / grid[0];
    work.face[1] = image->height / grid[1];
    work.above = lobe_allocate(lobe_host_allocator(host), 4 * (size_t)image->width, sizeof(float));
    work.current =
        lobe_allocate(lobe_host_allocator(host), 4 * (size_t)image->width, sizeof(float));
    const bool room = work.above && work.current;
    if (room) {
        clear_empty_parts(&work);
        for (uint32_t y = 0; y < image->height; y++)
            mend_row(&work, y);
        report(&work, host);
    }
    lobe_release(work.above);
    lobe_release(work.current);
    return room ? LOBE_OK
                : lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                                 environment->name);
}
