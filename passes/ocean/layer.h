#ifndef PASSES_OCEAN_LAYER_H
#define PASSES_OCEAN_LAYER_H

#include "passes/ocean/sea.h"

/// One of a sea's periodic maps: the waves of a band of k, rad/m, whose wave vectors are 2
/// pi/length times whole numbers (n, m), in (-size/2, size/2). Column n and row m of a table are
/// those modulo the size.
typedef struct ocean_layer {
    uint32_t index, size, seed;
    double length;   ///< metres
    double from, to; ///< k: in [from, to); `to` may be INFINITY
} ocean_layer;

ocean_layer passes_ocean_layer(const lobe_ocean_parameters *parameters, uint32_t index);

/// Fills size^2 complex amplitudes h0, metres: the height at time t is the real part of the sum of
///   h0(k) e^(i(k x - omega t)) + conj(h0(-k)) e^(i(k x + omega t)).
/// Each depends on the seed and its own n and m, not on the size. Tessendorf 2001, Simulating Ocean
/// Water, Eqs. 42 and 43.
void passes_ocean_layer_amplitudes(const ocean_layer *layer, const sea *sea, float *amplitudes);

/// The expected covariance (xx, yy, xy) of slopes that are interpolated linearly between texels.
void passes_ocean_layer_slopes(const ocean_layer *layer, const sea *sea, double covariance[3]);

#endif
