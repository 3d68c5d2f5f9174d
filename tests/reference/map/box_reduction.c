#include "tests/reference/map/box_reduction.h"

#include <math.h>
#include <stddef.h>

static uint32_t reduced(uint32_t size) {
    return size > 1 ? size / 2 : 1;
}

double reference_box_weight(uint32_t i, uint32_t size, uint32_t j) {
    // The length they have in common, in texels of the target.
    double scale = (double)size / reduced(size);
    double low = fmax(i, j * scale), high = fmin(i + 1.0, (j + 1) * scale);
    return fmax(high - low, 0) / scale;
}

static void add_row(const reference_layers *source, uint32_t y, double weight, uint32_t x,
                    uint32_t layer, double *sum) {
    // An odd size has three texels under a target texel, and none beyond.
    for (uint32_t i = 2 * x; i < source->width && i < 2 * x + 3; i++) {
        const double *texel = reference_texel(source, i, y, layer);
        double share = weight * reference_box_weight(i, source->width, x);
        for (int channel = 0; channel < 4; channel++)
            sum[channel] += share * texel[channel];
    }
}

reference_layers reference_reduce(const reference_layers *source) {
    reference_layers target =
        reference_layers_allocate(reduced(source->width), reduced(source->height), source->layers);
    for (uint32_t layer = 0; layer < target.layers; layer++)
        for (uint32_t y = 0; y < target.height; y++)
            for (uint32_t x = 0; x < target.width; x++)
                for (uint32_t i = 2 * y; i < source->height && i < 2 * y + 3; i++)
                    add_row(source, i, reference_box_weight(i, source->height, y), x, layer,
                            reference_texel(&target, x, y, layer));
    return target;
}

void reference_mean(const reference_layers *source, double *means) {
    size_t count = (size_t)source->width * source->height;
    for (uint32_t layer = 0; layer < source->layers; layer++) {
        const double *texels = reference_texel(source, 0, 0, layer);
        for (int channel = 0; channel < 4; channel++) {
            double sum = 0;
            for (size_t i = 0; i < count; i++)
                sum += texels[4 * i + channel];
            means[4 * layer + channel] = sum / count;
        }
    }
}
