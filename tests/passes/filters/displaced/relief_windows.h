#ifndef TESTS_PASSES_FILTERS_DISPLACED_RELIEF_WINDOWS_H
#define TESTS_PASSES_FILTERS_DISPLACED_RELIEF_WINDOWS_H

#include "passes/filters/displaced/transfer_map.h"
#include "tests/passes/support/pass_run.h"

/// A long relief in which nothing is seen from far away, so that windows make what one window
/// makes, bit for bit. With its facets' normals.

enum { WINDOWS_WIDTH = 512, WINDOWS_HEIGHT = 16 };

/// The most facets of windows whose tiles are so many texels long, a multiple of 8.
#define WINDOWS_FACETS(texels) (2 * (2 * (WINDOW_MARGIN + (texels))) * WINDOWS_HEIGHT)

typedef struct relief_windows {
    pass_run run;
    lobe_scene *scene;
    transfer_kind kind;
} relief_windows;

/// Uploads the relief, and begins a frame. `most_facets`: of a window; 0: there is one.
void relief_windows_begin(relief_windows *windows, fixture *f, bool coloured, uint64_t most_facets);
void relief_windows_end(relief_windows *windows);

/// Numbers of a map and of its facets' normals, one after the other.
size_t relief_windows_count(const transfer_map *map);
/// Executes the frame and returns them; the caller frees them.
float *relief_windows_read(relief_windows *windows, const transfer_map *map);

#endif
