#ifndef MIRRORED_GLSL
#define MIRRORED_GLSL

// How much a lobe counts in the moments of a bin with colours, over its mass: where dark texels are
// rough and bright ones smooth, the bin's light is that of the bright ones. Whoever includes this
// declares MODEL.

#include "interface/material.h"
#include "interface/mirrored.h"
#include "lib/light/luminance.glsl"

// The luminance of F0, at most 1 with colours in units that hold them. `colour`: of metal in this
// unit, and how much is not metal; of one lobe, or the mean of several.
float mirrored_by(vec4 colour, float unit) {
    if (MODEL != MODEL_MICROFACET)
        return 1.0;
    float reflected = unit * lobe_luminance(colour.rgb) + DIELECTRIC_F0 * colour.a;
    return mix(reflected / max(unit, 1.0), 1.0, LEAST_MIRRORED_BINS);
}

#endif
