#ifndef INTERFACE_WAVES_H
#define INTERFACE_WAVES_H

#include "ocean.h"
#include "specialisation.h"
#include "types.h"

// Waves on a surface (lobe_waves in lobe/scene.h).

// Layers of a filtered map of waves, three for each layer of waves. J: the area, relative to the
// surface's, of what a point of the map stands for; s: the slope there. All are means over x.
//   [0]  J, J s_x, J s_y, 0
//   [1]  J s_x^2, J s_y^2, J s_x s_y, 0
//   [2]  D_x, D_y, 0, 0
#define WAVE_LAYER_FIRST  0
#define WAVE_LAYER_SECOND 1
#define WAVE_LAYER_PLACE  2
#define WAVE_MAP_LAYERS   3

// Steeper water breaks.
#define WAVE_SLOPE_MAXIMUM 1.0

// uint, [1, OCEAN_MAXIMUM_LAYERS]
#define SPECIALISE_WAVE_LAYERS (SPECIALISE_FILTER + 62)
// bool: points move across
#define SPECIALISE_WAVES_CHOPPY (SPECIALISE_FILTER + 63)

// A uniform block. Covariances of slopes: (xx, yy, xy).
struct wave_constants {
    float4 frequency; // of each layer, one over its length
    float4 rest;      // covariance that no layer has
    float4 total;     // of all waves
};
INTERFACE_SIZE(wave_constants, 48)
INTERFACE_OFFSET(wave_constants, rest, 16)
INTERFACE_OFFSET(wave_constants, total, 32)

// Push constants of wave_moments.comp.
struct wave_moments_constants {
    uint size; // texels along each side of the maps that are read
};
INTERFACE_SIZE(wave_moments_constants, 4)

#endif
