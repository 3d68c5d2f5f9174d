#ifndef PASSES_FILTERS_DISPLACED_WINDOW_H
#define PASSES_FILTERS_DISPLACED_WINDOW_H

#include "passes/filters/displaced/transfer_kind.h"

/// Which facets buffers hold at a time, see shaders/interface/displacement/relief.h.
typedef struct facet_window {
    uint32_t x, y; ///< first quad in the relief
    uint32_t width, height;
    /// The texels of the map that are made of it.
    uint32_t first_column, first_row, columns, rows;
} facet_window;

/// What lies around a tile in its window, where that is not all of the relief: quads. Light that
/// comes from farther away is taken from elsewhere in the window.
#define WINDOW_MARGIN 64

/// How a relief is divided: 1 x 1, or tiles whose windows have at most so many facets.
typedef struct window_grid {
    uint32_t relief_width, relief_height;
    uint32_t columns, rows;
} window_grid;

window_grid passes_window_grid(const device_map *heights, uint64_t most_facets);
/// Row by row; of columns * rows.
facet_window passes_window(const window_grid *grid, uint32_t index);
uint32_t passes_window_facets(const facet_window *window);

/// The most facets of a window.
uint64_t passes_window_limit(void);

/// Names the window in the constants.
void passes_window_constants(const facet_window *window, struct transfer_constants *constants);

#endif
