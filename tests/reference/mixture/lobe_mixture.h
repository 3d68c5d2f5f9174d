#ifndef TESTS_REFERENCE_MIXTURE_LOBE_MIXTURE_H
#define TESTS_REFERENCE_MIXTURE_LOBE_MIXTURE_H

#include <stdint.h>

#include "tests/reference/mixture/layers.h"

/// Mixtures of lobes in double precision: Xu, Wang, Zhao, Bao, 2017, Real-Time Linear BRDF
/// MIP-Mapping, sections 3.1 and 3.2. Layers as in shaders/interface/mixture.h, in its fullest
/// form: one lobe, four sectors, eight halves, and the mean normal with the mean of 1 - |r|.
enum {
    REFERENCE_MIXTURE_LAYERS = 14,
    REFERENCE_MIXTURE_LAYER_ONE = 0,
    REFERENCE_MIXTURE_LAYER_SECTORS = 1,
    REFERENCE_MIXTURE_LAYER_HALVES = 5,
    REFERENCE_MIXTURE_LAYER_MEAN = 13,
};

/// A von Mises-Fisher lobe of a texel.
typedef struct reference_lobe {
    double axis[3]; ///< unit length
    double concentration;
    double share; ///< of the texel's lobes; they add up to one
} reference_lobe;

/// Adds a lobe to a texel: (share r, share) to its clusters, share (1 - |r|) to the mean. A texel
/// that is left out (outside the atlas, facing away) gets none, so its coverage stays 0.
void reference_add_lobe(const reference_layers *mixture, uint32_t x, uint32_t y,
                        const reference_lobe *lobe);

/// Adds the texel's normal to the mean.
void reference_add_normal(const reference_layers *mixture, uint32_t x, uint32_t y,
                          const double normal[3]);

/// rho at a direction of one layer's lobe, its weight included: w vMF(direction; sum / w).
double reference_evaluate_cluster(const reference_layers *mixture, uint32_t x, uint32_t y,
                                  uint32_t layer, const double direction[3]);

/// rho at a direction of all clusters of a subdivision (0: 1, 1: 4, 2: 8 lobes): Eq. 15.
double reference_evaluate_mixture(const reference_layers *mixture, uint32_t x, uint32_t y,
                                  uint32_t subdivision, const double direction[3]);

#endif
