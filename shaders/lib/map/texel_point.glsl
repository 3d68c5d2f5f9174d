#ifndef LIB_TEXEL_POINT_GLSL
#define LIB_TEXEL_POINT_GLSL

#include "interface/lobe_grid.h"

// Points at which a map that is interpolated between the centres of its texels is averaged.
//
// Along a row, values between two centres are a line, whose square Gauss's rule of two points
// integrates exactly: at the parts g and 1 - g of the way, g = (1 - 1/sqrt 3)/2. Of these, each
// texel has those next to its centre, g to either side. In the plane that makes four points a
// texel; two on a diagonal give the same means of values and of products of two values over any
// area much larger than a texel. Of four values between centres, the point (g, g) has the weights
// (1-g)^2, (1-g)g, (1-g)g, g^2; summed over the plane, products of texels at every distance then
// have the weights of the integral: 4/9 for a texel with itself, 1/9 with a neighbour, 1/36 with
// one across. Where texels are independent, this leaves 4/9 of their variance.

// In texels, from the centre.
vec2 texel_point(int index) {
    return vec2(index == 0 ? TEXEL_POINT : -TEXEL_POINT);
}

// Under a mask, what is kept ends inside texels, wherever alpha meets the cutoff, and of normals
// that are interpolated only those count that lie on one side. Points that suit products are then
// wrong: both are about as far from the texel's centre. Where few normals repeat, as in folds of a
// texel, they miss most of those in between. These fill the texel evenly: a lattice of rank 1
// (Sloan, Joe 1994, Lattice Methods for Multiple Integration), moved so that each quarter of the
// texel has four.
vec2 many_texel_point(int index) {
    float count = float(MANY_TEXEL_POINTS), along = float(index);
    return vec2((along + 0.5) / count, fract((3.0 * along + 5.5) / count)) - 0.5;
}

#endif
