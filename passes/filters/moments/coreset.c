#include "passes/filters/moments/coreset.h"

#include <math.h>

#include "passes/context/sample_pattern.h"

static void aim(coreset *set) {
    set->next = (set->count + passes_hashed_number(set->count)) * set->part;
}

void passes_coreset_begin(coreset *set, double total, double least) {
    set->part = fmax(total / CORESET_TEXELS, least);
    set->sum = 0;
    set->count = 0;
    aim(set);
}

/// Keeps one texel of each two parts.
static void merge_parts(coreset *set) {
    set->count /= 2;
    set->part *= 2;
    for (uint32_t i = 0; i < set->count; i++)
        set->texels[i] = set->texels[2 * i + (passes_hashed_number(i) < 0.5)];
}

static void draw(coreset *set, uint32_t x, uint32_t y, float density) {
    set->texels[set->count++] = (coreset_texel){x, y, 1 / density};
    if (set->count == CORESET_TEXELS)
        merge_parts(set);
    aim(set);
}

static double sum_of(const float *density, uint32_t count) {
    float sums[8] = {0};
    uint32_t i = 0;
    for (; i + 8 <= count; i += 8)
        for (uint32_t k = 0; k < 8; k++)
            sums[k] += density[i + k];
    for (; i < count; i++)
        sums[0] += density[i];
    double sum = 0;
    for (uint32_t k = 0; k < 8; k++)
        sum += (double)sums[k];
    return sum;
}

void passes_coreset_add_row(coreset *set, const float *density, uint32_t width, uint32_t y) {
    const double end = set->sum + sum_of(density, width);
    // Most rows of a large map are passed over.
    for (uint32_t x = 0; x < width && set->next < end; x++) {
        set->sum += (double)density[x];
        while (set->next < set->sum)
            draw(set, x, y, density[x]);
    }
    set->sum = end;
}
