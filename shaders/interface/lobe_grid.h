#ifndef INTERFACE_LOBE_GRID_H
#define INTERFACE_LOBE_GRID_H

#include "types.h"

// Push constants of the passes that make one texel of lobes for each texel of a material's maps:
// lobe_clustering, parameter_averaging, slope_moments and moment_binning. They bound loops over
// texels: with a uniform block instead, lavapipe would recompile the shader for each content.
struct lobe_grid_constants {
    uint width; // of the base maps, texels: the larger of the normal and the width map
    uint height;
    uint level;   // of the map that is made, where a pass makes tiles of any level
    float alpha;  // factor of the base colour map's alpha, where lobes are masked
    float cutoff; // what is below is cut away
};
INTERFACE_SIZE(lobe_grid_constants, 20)
INTERFACE_OFFSET(lobe_grid_constants, height, 4)
INTERFACE_OFFSET(lobe_grid_constants, level, 8)
INTERFACE_OFFSET(lobe_grid_constants, alpha, 12)
INTERFACE_OFFSET(lobe_grid_constants, cutoff, 16)

// Points of a texel at which interpolated maps are read, and how far they are from its centre along
// both axes, in texels: see lib/map/texel_point.glsl.
#define TEXEL_POINTS 2
#define TEXEL_POINT  0.21132487
// The same where a mask cuts texels, or few normals repeat.
#define MANY_TEXEL_POINTS 16

#endif
