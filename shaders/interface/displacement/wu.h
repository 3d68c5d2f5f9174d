#ifndef INTERFACE_WU_H
#define INTERFACE_WU_H

#include "../specialisation.h"
#include "../types.h"

// What the filter `wu` keeps of a relief (relief.h): models of it at several levels. A model has a
// coarse relief, whose quads are *cells*; for each cell a mixture of lobes of the normals of the
// facets under it; and factors that correct what those reflect: a table S of pairs of directions,
// and one number T for each cell.
//
// Of the whole map there are the parts of the light that path_energy finds. Where facets have
// microfacets, an S and T of what these mirror follow: of each level first S, by pairs of
// directions, then T, by patches.
//
// Frame and lengths are the relief's, but the heights of a coarse relief are in widths of its
// cells.

// As the paper prints it: means of ratios, not ratios of means; Eq. 5 of lobes of normals, in which
// the area that they show to the viewer does not count.
#define WU_PRINTED_RATIO 1
#define WU_PRINTED_LOBES 2

#define WU_LEVELS        8
#define WU_MAXIMUM_LOBES 8
#define WU_AZIMUTHS      16

struct wu_level {
    uint first_cell;
    uint width; // cells
    uint height;
    uint first_pair; // in the tables of S
    float spacing_x; // texels of the relief to a cell
    float spacing_y;
    float unit;   // of heights: sqrt(spacing_x spacing_y)
    float octave; // log2 of the texels to a cell, above that of the level before
};
INTERFACE_SIZE(wu_level, 32)
INTERFACE_OFFSET(wu_level, width, 4)
INTERFACE_OFFSET(wu_level, height, 8)
INTERFACE_OFFSET(wu_level, first_pair, 12)
INTERFACE_OFFSET(wu_level, spacing_x, 16)
INTERFACE_OFFSET(wu_level, spacing_y, 20)
INTERFACE_OFFSET(wu_level, unit, 24)
INTERFACE_OFFSET(wu_level, octave, 28)
#ifndef VULKAN
typedef struct wu_level wu_level;
#endif

struct wu_constants {
    uint width; // texels
    uint height;
    uint level_count;
    uint angular; // directions are the middles of a square of angular x angular
    uint patches; // the map is divided into patches x patches
    uint points;  // of each patch, at which paths start
    uint bounces; // vertices of a path, at most
    uint printed; // WU_PRINTED_...
    wu_level levels[WU_LEVELS];
};
INTERFACE_SIZE(wu_constants, 288)
INTERFACE_OFFSET(wu_constants, height, 4)
INTERFACE_OFFSET(wu_constants, level_count, 8)
INTERFACE_OFFSET(wu_constants, angular, 12)
INTERFACE_OFFSET(wu_constants, patches, 16)
INTERFACE_OFFSET(wu_constants, points, 20)
INTERFACE_OFFSET(wu_constants, bounces, 24)
INTERFACE_OFFSET(wu_constants, printed, 28)
INTERFACE_OFFSET(wu_constants, levels, 32)

// A cell (std430).
struct wu_cell {
    // Of the normals' density per steradian and area of the base: xyz: direction times weight, w:
    // concentration (von Mises-Fisher).
    float4 lobes[WU_MAXIMUM_LOBES];
    float4 slopes; // of the coarse relief's facets in the cell: lower, upper
    // T = (n0 + n1 m + n2 m^2) / (d0 + d1 m + d2 m^2), where m is the part of the light that is
    // from other facets, by albedo.
    float4 numerator;
    float4 denominator;
    // Sines of the elevations from which on nothing, and above which all of the coarse relief's
    // facets sees the sky, by azimuth: four bytes, of the lower facet, then of the upper.
    uint horizons[WU_AZIMUTHS];
};
INTERFACE_SIZE(wu_cell, 240)
INTERFACE_OFFSET(wu_cell, slopes, 128)
INTERFACE_OFFSET(wu_cell, numerator, 144)
INTERFACE_OFFSET(wu_cell, denominator, 160)
INTERFACE_OFFSET(wu_cell, horizons, 176)

// Push constants of the passes that make models.
struct wu_step {
    uint level;
    uint samples; // of each patch
    uint one_way; // pair_means: 1: the first direction is the light's, the second the viewer's
    uint alike;   // pair_means: 1: both sides are the same, and so are products of either order
};
INTERFACE_SIZE(wu_step, 16)
INTERFACE_OFFSET(wu_step, samples, 4)

// Which directions are seen from a point of a patch: by the coarse relief's two facets, and by the
// facet of the map. Bits of each direction.
#define WU_SEES_LOWER 1u
#define WU_SEES_UPPER 2u
#define WU_SEES_FACET 4u
#define WU_SIGHT_BITS 8u

// Normals drawn for each point of a patch.
#define WU_DRAWS 4

// Microfacets of the facets from which S and T of what they mirror are found (von Mises-Fisher):
// how much the coarse relief lacks hardly depends on it.
#define WU_MIRROR_CONCENTRATION 50.0

// uint, [1, WU_MAXIMUM_LOBES]
#define SPECIALISE_WU_LOBES (SPECIALISE_FILTER + 40)

#endif
