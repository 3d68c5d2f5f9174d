#ifndef INTERFACE_MOMENT_REFIT_H
#define INTERFACE_MOMENT_REFIT_H

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

// Push constants of moment_refit.
struct refit_constants {
    uint cells;
    uint lobes;     // of the sample; of each x, y: place, z: variance, w: weight
    float points;   // that a lobe counts as; see lib/lobe/bin_membership.glsl
    uint bins;      // not a specialisation constant: one pipeline serves most materials
    uint has_first; // 0: there are no first bins to start from
};
INTERFACE_SIZE(refit_constants, 20)
INTERFACE_OFFSET(refit_constants, lobes, 4)
INTERFACE_OFFSET(refit_constants, points, 8)
INTERFACE_OFFSET(refit_constants, bins, 12)
INTERFACE_OFFSET(refit_constants, has_first, 16)

#endif
