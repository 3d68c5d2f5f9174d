#ifndef INTERFACE_GAUSSIAN_MIXTURE_H
#define INTERFACE_GAUSSIAN_MIXTURE_H

#include "specialisation.h"
#include "types.h"

// What the passes that fit a mixture of Gaussians to each texel of a map exchange. The mixture's
// own map and its constants are those of moment_bins.h, with a component for each bin.
//
// mixture_samples writes an array of images, of the size of the lobe grid. With n layers for each
// base lobe i of a texel, m its mass, p its place and v its variance, as means over the texel:
// [n i + 0]  p_x, p_y, 1 / sqrt(v), v
// [n i + 1]  covariance of p inside the texel (xx, yy, xy), m
// [n i + 2]  where components have colours: the specular colour, as in moment_bins.h
// [last]     where components have colours: the diffuse colour
// Colours are in units of the material's largest_colour.
//
// Components of a texel's mixture, in two layers each:
// [2 j]      part of all lobes, then the mean: x, y from the origin of the places, and the width
// [2 j + 1]  covariance (xx, yy, xy), variance of the width
// A width is the logarithm of a lobe's deviation sqrt(v), times the material's usual deviation, so
// that widths and places have one unit.

// Components of a texel's mixture, at most. In the Lambert plane they are bins: at most
// MOMENT_MAXIMUM_BINS.
#define MIXTURE_MAXIMUM_COMPONENTS 7

// A group of mixture_samples takes a square of so many texels along each side.
#define MIXTURE_TILE 32

#define SPECIALISE_MIXTURE_SHAPE (SPECIALISE_FILTER + 25) // uint, MIXTURE_SHAPE_...
#define SPECIALISE_MIXTURE_PLANE (SPECIALISE_FILTER + 26) // uint, MIXTURE_PLANE_...
#define SPECIALISE_MIXTURE_START (SPECIALISE_FILTER + 27) // uint, MIXTURE_START_...
#define SPECIALISE_MIXTURE_PRINTED                                                                 \
    (SPECIALISE_FILTER + 28) // bool: formulas as Tan et al. print them

// Places of directions, and with it what the map holds.
// The Lambert plane: the moments of moment_bins.h, with a component for each bin.
#define MIXTURE_PLANE_LAMBERT 0
// Tan et al. 2005: x and y of the direction. A layer for each component: with its part a, mean m
// and variance s^2 along each axis, base lobes included, a, a m_x, a m_y, a (2 s^2 + |m|^2), or as
// printed a (s^2 + |m|^2).
#define MIXTURE_PLANE_PROJECTED 1
// Slopes (slope_moments.h). As in the Lambert plane, but all masses are those of base lobes of area
// one, and v is their variance in slopes.
#define MIXTURE_PLANE_SLOPES 2

// Of components while lobes are shared out among them; what they get of these may have any.
#define MIXTURE_SHAPE_AUTOMATIC 0 // as serves the material better
#define MIXTURE_SHAPE_ROUND     1
#define MIXTURE_SHAPE_OVAL      2

#define MIXTURE_START_PARENT      0 // the components of the texel's parent
#define MIXTURE_START_K_MEANS     1 // the texel's lobes alone
#define MIXTURE_START_CLOSEST     2 // whichever of both lead closer to the lobes
#define MIXTURE_ROUNDS_OF_K_MEANS 5 // of mixture_level

// Least values over the texels of a tile: the negative of what is largest.
struct mixture_extremes {
    float4 places; // x, y: places of lobes; z, w: -x, -y of them
    float4 lobes;  // -1 / sqrt(v), -v, -mass of a texel's lobes, -texel of the components' colours
};
INTERFACE_SIZE(mixture_extremes, 32)
INTERFACE_OFFSET(mixture_extremes, lobes, 16)

// Push constants of the passes that fit components to the samples.
struct mixture_fit_constants {
    uint width; // of the lobe grid, texels
    uint height;
    uint steps;     // of expectation maximisation
    float prior;    // how many samples a neighbour's component is worth, times its part
    uint first_row; // of mixture_level's texels
    uint own_steps; // MIXTURE_START_CLOSEST: from a texel's own start; 0: that is not tried
    // The same: of the squared lobes, that these components must be closer than those from the
    // parent's.
    float least_gain;
};
INTERFACE_SIZE(mixture_fit_constants, 28)
INTERFACE_OFFSET(mixture_fit_constants, height, 4)
INTERFACE_OFFSET(mixture_fit_constants, steps, 8)
INTERFACE_OFFSET(mixture_fit_constants, prior, 12)
INTERFACE_OFFSET(mixture_fit_constants, first_row, 16)
INTERFACE_OFFSET(mixture_fit_constants, own_steps, 20)
INTERFACE_OFFSET(mixture_fit_constants, least_gain, 24)

// Push constants of mixture_likeness, which writes for the four texels of a level that start at
// one, as a bilinear sampler blends them: 1 where two of them have components too unlike for that,
// else 0.5 where they and what is blended of the next level around them have, else 0.
struct mixture_likeness_constants {
    uint mirrored_x; // bool: the map is
    uint mirrored_y;
    uint level;      // of the mixture's map
    float tolerance; // squared error of a blend halfway, in parts of what is blended
};
INTERFACE_SIZE(mixture_likeness_constants, 16)
INTERFACE_OFFSET(mixture_likeness_constants, level, 8)
INTERFACE_OFFSET(mixture_likeness_constants, tolerance, 12)

#endif
