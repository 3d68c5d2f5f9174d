#ifndef TOOLS_COMPARE_CONVOLUTION_H
#define TOOLS_COMPARE_CONVOLUTION_H

#include <stddef.h>

/// Separable filtering of planes (one float per texel, rows packed). Beyond its border a plane
/// continues with the value at the border.

#define CONVOLUTION_MAXIMUM_RADIUS 80

/// weights[radius + i] belongs to the texel i places on.
typedef struct convolution_kernel {
    int radius; ///< [0, CONVOLUTION_MAXIMUM_RADIUS]
    float weights[2 * CONVOLUTION_MAXIMUM_RADIUS + 1];
} convolution_kernel;

/// exp(-i^2 / (2 deviation^2)), normalised to the sum 1; deviation in texels, above 0.
void convolution_gaussian(convolution_kernel *kernel, double deviation, int radius);

/// First (`order` 1) or second (`order` 2) derivative of that Gaussian, scaled such that its
/// positive weights sum to 1 and its negative weights to -1.
void convolution_gaussian_derivative(convolution_kernel *kernel, double deviation, int radius,
                                     int order);

/// Filters along the row. `padded` is scratch of width + 2 CONVOLUTION_MAXIMUM_RADIUS floats;
/// `result` has `width` floats and may be `row`.
void convolution_row(const float *row, size_t width, const convolution_kernel *kernel,
                     float *padded, float *result);

/// Filters along the columns, for row `y` only; `result` has `width` floats.
void convolution_columns(const float *plane, size_t width, size_t height, size_t y,
                         const convolution_kernel *kernel, float *result);

#endif
