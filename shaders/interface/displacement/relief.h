#ifndef INTERFACE_RELIEF_H
#define INTERFACE_RELIEF_H

#include "../specialisation.h"
#include "../types.h"

// The relief of a material with a height map: a surface of two triangles for each square between
// the centres of four neighbouring texels, repeated without end. Lengths are in widths of a texel.
// Its frame: x along u, y along v (opposite to y of the tangent frame), z outwards; texel (i, j) is
// the vertex at (i, j). The height of the carrier is the mean of all texels'.
//
// height_block holds the texels' heights, then levels of maxima: a value of level l is the largest
// height of a square of 4^l by 4^l quads, cut off at the map's ends.
#define HEIGHT_LEVELS 8
struct height_level {
    uint offset; // of its first value
    uint width;  // values
    uint height;
    uint padding;
};
INTERFACE_SIZE(height_level, 16)
INTERFACE_OFFSET(height_level, width, 4)
INTERFACE_OFFSET(height_level, height, 8)
#ifndef VULKAN
typedef struct height_level height_level;
#endif

struct height_field_constants {
    uint width; // texels
    uint height;
    uint last_level;                    // of one value
    float scale;                        // of the map's values, widths of a texel
    height_level levels[HEIGHT_LEVELS]; // level 0: the texels
};
INTERFACE_SIZE(height_field_constants, 144)
INTERFACE_OFFSET(height_field_constants, height, 4)
INTERFACE_OFFSET(height_field_constants, last_level, 8)
INTERFACE_OFFSET(height_field_constants, scale, 12)
INTERFACE_OFFSET(height_field_constants, levels, 16)

// Heights beyond this, in widths of a texel, are cut off.
#define HEIGHT_MAXIMUM 65536.0

// ---------------------------------------------------------------------------------------------
// What the filter `displaced` keeps of a relief. b are the coefficients, in the functions of
// lib/displacement/transfer_basis.glsl, of the cosine of a facet's normal where its centre sees the
// sky; o are those of the light that other facets send it, if all reflect everything and the sky
// shines as each function. With a, the area of a facet over that of its projection, and means over
// the facets of a cell:
//
// entries of a texel, four to a layer:
// [0, n (n + 1) / 2)   C = mean a b b^T / pi, lower triangle, row by row; n: order
// then 10              N = mean a (b o^T + o b^T) / (2 pi), of the first four functions
// then                 mean of what the facets reflect of light that has met one other facet
// then n               mean a b: the area that is seen from each direction, over that of the cell
#define TRANSFER_MAXIMUM_ORDER  9
#define TRANSFER_INDIRECT       4
#define TRANSFER_INDIRECT_COUNT 10
#define TRANSFER_LINKS          4
#define TRANSFER_WORDS          5 // of a facet's b, two coefficients to a word

// Of the whole map, written by transfer_closure.
struct transfer_closure_constants {
    // What the mean of C and N lacks, so that a white relief reflects all light.
    float4 lacking[3]; // the last is 0, but for x
    float4 visible[3]; // mean a b, likewise
    float persistence; // [0, 1): the part of light between facets that meets another one
    float direct;      // the part of diffuse light that a white relief reflects at once
    float radius;      // of the facets' normals, see below
    float padding;
};
INTERFACE_SIZE(transfer_closure_constants, 112)
INTERFACE_OFFSET(transfer_closure_constants, visible, 48)
INTERFACE_OFFSET(transfer_closure_constants, persistence, 96)
INTERFACE_OFFSET(transfer_closure_constants, direct, 100)
INTERFACE_OFFSET(transfer_closure_constants, radius, 104)

// The facets' normals as places in the Lambert plane of the tangent frame, in bins
// (lib/displacement/facet_bins.glsl): the first of those nearer to the pole than the others, then
// one for each half axis. Of each bin, two layers of means over a cell: a and a d_x, a d_y; then a
// d_x^2, a d_y^2, a d_x d_y, with d the place less the bin's centre. `radius` is the mean distance
// of the map's places from the pole.
#define FACET_BINS 5

// Push constants of the passes between.
struct transfer_constants {
    uint width; // quads
    uint height;
    uint azimuths;
    uint first; // facet_bounces: 1 in the first step
};
INTERFACE_SIZE(transfer_constants, 16)
INTERFACE_OFFSET(transfer_constants, height, 4)
INTERFACE_OFFSET(transfer_constants, azimuths, 8)
INTERFACE_OFFSET(transfer_constants, first, 12)

// uint, 4 or 9: how many functions C has
#define SPECIALISE_TRANSFER_ORDER (SPECIALISE_FILTER + 32)

// bool: the material has a relief
#define SPECIALISE_RELIEF (SPECIALISE_FILTER + 30)
// uint, of `displaced-reference`: vertices of a path, at most
#define SPECIALISE_PATH_VERTICES (SPECIALISE_FILTER + 31)

#endif
