#ifndef INTERFACE_MOMENT_REFIT_H
#define INTERFACE_MOMENT_REFIT_H

#include "moment_bins.h"
#include "types.h"

// What the passes moment_cell_survey and moment_refit exchange, when texels of a material have
// changed: what the lobes of its maps are within, and a sample of them.

// The lobe grid is cut into at most so many cells along each axis, of which each gives so many of
// its texels.
#define SURVEY_CELLS 32
#define SURVEY_DRAWS 2
// Where maps are made from parts of their texels (knob `texel_samples`), so many texels along each
// axis of a cell are read, and not all.
#define SURVEY_PART 16

// Push constants of moment_cell_survey. They bound loops over texels: see lobe_grid.h.
struct cell_survey_constants {
    uint width; // of the lobe grid, texels
    uint height;
    uint columns; // cells
    uint rows;
    uint part;   // most texels of a cell that are read along each axis; 0: all
    float alpha; // as in lobe_grid_constants
    float cutoff;
};
INTERFACE_SIZE(cell_survey_constants, 28)
INTERFACE_OFFSET(cell_survey_constants, height, 4)
INTERFACE_OFFSET(cell_survey_constants, columns, 8)
INTERFACE_OFFSET(cell_survey_constants, rows, 12)
INTERFACE_OFFSET(cell_survey_constants, part, 16)
INTERFACE_OFFSET(cell_survey_constants, alpha, 20)
INTERFACE_OFFSET(cell_survey_constants, cutoff, 24)

// Least values over the texels of a cell: the negative of what is largest.
struct survey_extremes {
    float4 places;  // x, y: places of lobes; z, w: -x, -y of them
    float4 factors; // x: factor of the widths; y: its negative; z: -texel of the bins' colours
};
INTERFACE_SIZE(survey_extremes, 32)
INTERFACE_OFFSET(survey_extremes, factors, 16)

// Where maps are interpolated, units of bins must hold what lies between texels of two bins: so
// many steps from one's middle to the other's are looked at, each with lobes from the sharpest to
// the broadest, as of those a bin may have only what is between.
#define BETWEEN_STEPS  8
#define BETWEEN_WIDTHS 8
#define BETWEEN_PLACES (BETWEEN_WIDTHS * (BETWEEN_STEPS - 1))

// Push constants of moment_refit.
struct refit_constants {
    uint cells;
    uint lobes;        // of the sample; of each x, y: place, z: variance, w: weight
    float points;      // that a lobe counts as; see lib/lobe/bin_membership.glsl
    uint bins;         // not a specialisation constant: one pipeline serves most materials
    uint has_first;    // 0: there are no first bins to start from
    uint follows;      // 0: nothing of earlier fits counts
    uint interpolated; // 0: there is nothing between texels
};
INTERFACE_SIZE(refit_constants, 28)
INTERFACE_OFFSET(refit_constants, lobes, 4)
INTERFACE_OFFSET(refit_constants, points, 8)
INTERFACE_OFFSET(refit_constants, bins, 12)
INTERFACE_OFFSET(refit_constants, has_first, 16)
INTERFACE_OFFSET(refit_constants, follows, 20)
INTERFACE_OFFSET(refit_constants, interpolated, 24)

// A bin as a Gaussian.
struct fit_gaussian {
    float4 place;  // x, y: mean; z: part of all lobes
    float4 spread; // covariance: xx, yy, xy
};
INTERFACE_SIZE(fit_gaussian, 32)
INTERFACE_OFFSET(fit_gaussian, spread, 16)
#ifndef VULKAN
typedef struct fit_gaussian fit_gaussian;
#endif

// What a fit leaves for the next one of the same material.
struct fit_state {
    fit_gaussian shown[MOMENT_MAXIMUM_BINS]; // the bins
    fit_gaussian other[MOMENT_MAXIMUM_BINS]; // what the search for better ones is at
    fit_gaussian old[MOMENT_MAXIMUM_BINS];   // what was shown before it became the other
    uint bins;                               // their number; 0: there has been no fit
    uint step;                               // of the search, see refit.comp, its rounds so far
    uint round;
    uint count;             // and its bins
    float likelihood;       // of the lobes under the bins that are followed, and
    float other_likelihood; // under those of the search
    float points;           // that a lobe counted as
    float reach;            // as in `progress` in refit.comp
    float middle_x;
    float middle_y;
    float narrowest;
    float broadest;
    uint texels;    // a number of the lobes that were fitted to
    uint quiet;     // fits since they changed
    uint rest;      // see refit.comp
    float part;     // of the way from the old ones to the other
    uint unchanged; // 1: another fit to the same texels leaves all as it is
    uint padding_0;
    uint padding_1;
    uint padding_2;
};
INTERFACE_SIZE(fit_state, 656)
INTERFACE_OFFSET(fit_state, other, 192)
INTERFACE_OFFSET(fit_state, old, 384)
INTERFACE_OFFSET(fit_state, bins, 576)
INTERFACE_OFFSET(fit_state, step, 580)
INTERFACE_OFFSET(fit_state, round, 584)
INTERFACE_OFFSET(fit_state, count, 588)
INTERFACE_OFFSET(fit_state, likelihood, 592)
INTERFACE_OFFSET(fit_state, other_likelihood, 596)
INTERFACE_OFFSET(fit_state, points, 600)
INTERFACE_OFFSET(fit_state, reach, 604)
INTERFACE_OFFSET(fit_state, middle_x, 608)
INTERFACE_OFFSET(fit_state, middle_y, 612)
INTERFACE_OFFSET(fit_state, narrowest, 616)
INTERFACE_OFFSET(fit_state, broadest, 620)
INTERFACE_OFFSET(fit_state, texels, 624)
INTERFACE_OFFSET(fit_state, quiet, 628)
INTERFACE_OFFSET(fit_state, rest, 632)
INTERFACE_OFFSET(fit_state, part, 636)
INTERFACE_OFFSET(fit_state, unchanged, 640)

// Once texels have stayed the same in so many fits, bins that become others do so in at most so
// many more, then become those of a fit anew in as many.
#define FIT_RESTS_AFTER  3
#define FITS_OF_SETTLING 32

#endif
