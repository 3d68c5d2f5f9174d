#include "tools/compare/convolution.h"

#include <math.h>
#include <string.h>

void convolution_gaussian(convolution_kernel *kernel, double deviation, int radius) {
    double sum = 0.0;
    for (int i = -radius; i <= radius; i++)
        sum += exp(-i * i / (2.0 * deviation * deviation));
    kernel->radius = radius;
    for (int i = -radius; i <= radius; i++)
        kernel->weights[radius + i] = (float)(exp(-i * i / (2.0 * deviation * deviation)) / sum);
}

static double gaussian_derivative(double x, double deviation, int order) {
    double gaussian = exp(-x * x / (2.0 * deviation * deviation));
    return order == 1 ? -x * gaussian : (x * x / (deviation * deviation) - 1.0) * gaussian;
}

void convolution_gaussian_derivative(convolution_kernel *kernel, double deviation, int radius,
                                     int order) {
    double positive = 0.0, negative = 0.0;
    for (int i = -radius; i <= radius; i++) {
        double weight = gaussian_derivative(i, deviation, order);
        positive += fmax(weight, 0.0);
        negative += fmax(-weight, 0.0);
    }
    kernel->radius = radius;
    for (int i = -radius; i <= radius; i++) {
        double weight = gaussian_derivative(i, deviation, order);
        double sum = weight > 0.0 ? positive : negative;
        kernel->weights[radius + i] = (float)(sum > 0.0 ? weight / sum : 0.0);
    }
}

void convolution_row(const float *row, size_t width, const convolution_kernel *kernel,
                     float *padded, float *result) {
    size_t radius = (size_t)kernel->radius;
    memcpy(padded + radius, row, width * sizeof *row);
    for (size_t i = 0; i < radius; i++) {
        padded[i] = row[0];
        padded[radius + width + i] = row[width - 1];
    }
    memset(result, 0, width * sizeof *result);
    for (size_t tap = 0; tap <= 2 * radius; tap++) {
        float weight = kernel->weights[tap];
        for (size_t x = 0; x < width; x++)
            result[x] += weight * padded[x + tap];
    }
}

static size_t clamp_row(size_t y, int offset, size_t height) {
    if (offset < 0)
        return y >= (size_t)-offset ? y - (size_t)-offset : 0;
    return y + (size_t)offset < height ? y + (size_t)offset : height - 1;
}

void convolution_columns(const float *plane, size_t width, size_t height, size_t y,
                         const convolution_kernel *kernel, float *result) {
    memset(result, 0, width * sizeof *result);
    for (int i = -kernel->radius; i <= kernel->radius; i++) {
        float weight = kernel->weights[kernel->radius + i];
        const float *row = plane + clamp_row(y, i, height) * width;
        for (size_t x = 0; x < width; x++)
            result[x] += weight * row[x];
    }
}
