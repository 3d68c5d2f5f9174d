#include "passes/ocean/layer.h"

#include <math.h>

#define PI 3.14159265358979323846
/// Waves to a length of the next layer, where its band begins.
#define LEAST_WAVES 6

ocean_layer passes_ocean_layer(const lobe_ocean_parameters *p, uint32_t index) {
    return (ocean_layer){
        .index = index,
        .size = p->size,
        .seed = p->seed,
        .length = p->lengths[index],
        .from = index == 0 ? 0 : LEAST_WAVES * 2 * PI / p->lengths[index],
        .to = index + 1 == p->layers ? INFINITY : LEAST_WAVES * 2 * PI / p->lengths[index + 1],
    };
}

/// The whole number that a column or row of a table stands for.
static int32_t wave_number(const ocean_layer *layer, uint32_t place) {
    return place < layer->size / 2 ? (int32_t)place : (int32_t)place - (int32_t)layer->size;
}

/// The density of variance at a wave vector times the area of its cell, m2; 0 outside of the band
/// and for the waves that texels cannot tell from their opposites.
static double variance_of(const ocean_layer *layer, const sea *sea, int32_t n, int32_t m) {
    const double step = 2 * PI / layer->length, k = step * hypot(n, m);
    const int32_t limit = -(int32_t)(layer->size / 2);
    if (n == limit || m == limit || k < layer->from || k >= layer->to)
        return 0;
    return passes_sea_density(sea, step * n, step * m) * step * step;
}

// ---------------------------------------------------------------------------------------------
// Amplitudes

/// Jarzynski, Olano 2020, Hash Functions for GPU Rendering: PCG in four dimensions.
static void hash(uint32_t v[4]) {
    for (int i = 0; i < 4; i++)
        v[i] = v[i] * 1664525u + 1013904223u;
    for (int round = 0; round < 2; round++) {
        v[0] += v[1] * v[3];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        v[3] += v[1] * v[2];
        for (int i = 0; round == 0 && i < 4; i++)
            v[i] ^= v[i] >> 16;
    }
}

/// Two independent numbers of a normal distribution (Box, Muller 1958).
static void normal_numbers(const ocean_layer *layer, int32_t n, int32_t m, double numbers[2]) {
    uint32_t v[4] = {(uint32_t)n, (uint32_t)m, layer->index, layer->seed};
    hash(v);
    const double radius = sqrt(-2 * log((v[0] + 0.5) / 4294967296.0));
    const double angle = 2 * PI * (v[1] + 0.5) / 4294967296.0;
    numbers[0] = radius * cos(angle);
    numbers[1] = radius * sin(angle);
}

void passes_ocean_layer_amplitudes(const ocean_layer *layer, const sea *sea, float *amplitudes) {
    for (uint32_t y = 0; y < layer->size; y++)
        for (uint32_t x = 0; x < layer->size; x++) {
            const int32_t n = wave_number(layer, x), m = wave_number(layer, y);
            const double scale = 0.5 * sqrt(variance_of(layer, sea, n, m));
            double numbers[2];
            normal_numbers(layer, n, m, numbers);
            *amplitudes++ = (float)(scale * numbers[0]);
            *amplitudes++ = (float)(scale * numbers[1]);
        }
}

// ---------------------------------------------------------------------------------------------
// Slopes

/// What linear interpolation leaves of the variance of a wave with n periods over the map.
static double interpolated(const ocean_layer *layer, int32_t n) {
    return (2 + cos(2 * PI * n / layer->size)) / 3;
}

void passes_ocean_layer_slopes(const ocean_layer *layer, const sea *sea, double covariance[3]) {
    const double step = 2 * PI / layer->length;
    covariance[0] = covariance[1] = covariance[2] = 0;
    for (uint32_t y = 0; y < layer->size; y++)
        for (uint32_t x = 0; x < layer->size; x++) {
            const int32_t n = wave_number(layer, x), m = wave_number(layer, y);
            const double part = variance_of(layer, sea, n, m) * step * step *
                                interpolated(layer, n) * interpolated(layer, m);
            covariance[0] += part * n * n;
            covariance[1] += part * m * m;
            covariance[2] += part * n * m;
        }
}
