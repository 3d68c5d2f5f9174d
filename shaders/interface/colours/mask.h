#ifndef INTERFACE_MASK_H
#define INTERFACE_MASK_H

#include "../types.h"

// Where vertices multiply a mask's alpha by factors that differ, its filtered map has layers: what
// is kept at several thresholds of the map's own alpha, in even steps (std140).
struct mask_thresholds {
    float least;
    float layers_per_alpha; // for a threshold higher by one
    float last_layer;       // its number
    float padding_0;
};
INTERFACE_SIZE(mask_thresholds, 16)
INTERFACE_OFFSET(mask_thresholds, layers_per_alpha, 4)
INTERFACE_OFFSET(mask_thresholds, last_layer, 8)

// Push constants of mask_coverage.
struct mask_constants {
    uint width; // of the base colour map, texels
    uint height;
    uint interpolated; // 1: the map is read with linear interpolation, 0: the nearest texel
    uint repeats_u;    // 1: beyond its edge the map begins again, 0: it is mirrored or goes on
    uint repeats_v;
    float alpha;  // factor of the map's alpha, in layer 0
    float cutoff; // what is below is cut away
    float step;   // by which the next layer's threshold of the map's own alpha is higher
};
INTERFACE_SIZE(mask_constants, 32)
INTERFACE_OFFSET(mask_constants, height, 4)
INTERFACE_OFFSET(mask_constants, interpolated, 8)
INTERFACE_OFFSET(mask_constants, repeats_u, 12)
INTERFACE_OFFSET(mask_constants, repeats_v, 16)
INTERFACE_OFFSET(mask_constants, alpha, 20)
INTERFACE_OFFSET(mask_constants, cutoff, 24)
INTERFACE_OFFSET(mask_constants, step, 28)

#endif
