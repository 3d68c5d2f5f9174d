#ifndef BASE_TAILS_GLSL
#define BASE_TAILS_GLSL

// Base lobes as sums of Gaussians of slopes, each of which the texels' Gaussian broadens. Slopes of
// GGX have Student's t distribution of two degrees of freedom, at the scale of Beckmann's
// distribution: such a sum. Seen at 70 degrees and lit from above, rough rock without the tails
// mirrors 1.5 times as much.

#include "lib/lobe/plane_lobe.glsl"

const uint TAIL_TERMS =
    MODEL == MODEL_MICROFACET && DISTRIBUTION == DISTRIBUTION_GGX && !BASE_AS_LOBE ? 4u : 1u;

// Of one of some terms: how much it counts, and its variance relative to that of the base lobe.
// One term is the base lobe without its tails.
float term_part(uint term, uint terms) {
    return terms > 1u ? tail_weight(0.0)[term] : 1.0;
}

float term_spread(uint term, uint terms) {
    return terms > 1u ? tail_spread(0.0)[term] : 1.0;
}

#endif
