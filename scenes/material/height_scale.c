#include "scenes/material/height_scale.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "scenes/material/image_channel.h"

static const double least_correlation = 0.2;
// Smallest z of a normal that counts: steeper ones would outweigh all others.
static const double least_cosine = 0.1;

// Slope per width of the map, towards higher columns and rows; the map repeats.
static void height_slope(const lobe_image *image, uint32_t column, uint32_t row, double slope[2]) {
    uint32_t w = image->width, h = image->height;
    double across = scenes_image_channel_value(image, (column + 1) % w, row, 0) -
                    scenes_image_channel_value(image, (column + w - 1) % w, row, 0);
    double down = scenes_image_channel_value(image, column, (row + 1) % h, 0) -
                  scenes_image_channel_value(image, column, (row + h - 1) % h, 0);
    slope[0] = across / 2 * w;
    slope[1] = down / 2 * w;
}

// A height field's normal is (-dh/dx, -dh/dy, 1); rows run against y.
static void normal_slope(const lobe_image *image, uint32_t column, uint32_t row, double slope[2]) {
    double z = fmax(2 * scenes_image_channel_value(image, column, row, 2) - 1, least_cosine);
    slope[0] = -(2 * scenes_image_channel_value(image, column, row, 0) - 1) / z;
    slope[1] = (2 * scenes_image_channel_value(image, column, row, 1) - 1) / z;
}

bool scenes_height_scale_find(const lobe_image *heights, const lobe_image *normals, float *scale) {
    double of_heights = 0, of_normals = 0, of_both = 0;
    if (heights->width != normals->width || heights->height != normals->height)
        return false;
    for (uint32_t row = 0; row < heights->height; row++)
        for (uint32_t column = 0; column < heights->width; column++) {
            double h[2], n[2];
            height_slope(heights, column, row, h);
            normal_slope(normals, column, row, n);
            of_heights += h[0] * h[0] + h[1] * h[1];
            of_normals += n[0] * n[0] + n[1] * n[1];
            of_both += h[0] * n[0] + h[1] * n[1];
        }
    double correlation = of_both / sqrt(of_heights * of_normals);
    if (!(fabs(correlation) >= least_correlation))
        return false;
    *scale = (float)copysign(sqrt(of_normals / of_heights), correlation);
    return true;
}
