#ifndef INTERFACE_HEMISPHERE_MOMENTS_H
#define INTERFACE_HEMISPHERE_MOMENTS_H

#include "../types.h"

// Moments of an environment's light over the hemisphere of a normal n, weighted by Lambert's
// cosine: the integral over <n, w> > 0 of
//   <n, w> L(w) w_x^i w_y^j w_z^k,  i + j + k = 3 or 2.
// Those of degree 1 and 0 are sums of them, because |w| = 1.
//
// In this order:
//   xxx xxy xxz xyy  xyz xzz yyy yyz  yzz zzz xx xy  xz yy yz zz
// Layer 4 c + l holds the l-th group of four of colour c, for L less its mean over all directions.
// The last layer holds that mean, whose moments have closed forms: uniform light is exact, however
// coarse the map.
#define HEMISPHERE_MOMENTS       16
#define HEMISPHERE_MOMENT_LAYERS 13

// Texels along the map of normals (lib/light/octahedron.glsl), without the border of one texel
// around it: 32 leave linear interpolation an error of 2e-3 of the irradiance of a single light.
#define HEMISPHERE_MOMENTS_SIZE 32

// Push constants of hemisphere_moments.
struct hemisphere_moments_constants {
    uint size; // texels along a face of the cube
};
INTERFACE_SIZE(hemisphere_moments_constants, 4)

#endif
