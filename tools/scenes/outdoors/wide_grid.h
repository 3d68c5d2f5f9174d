#ifndef TOOLS_SCENES_WIDE_GRID_H
#define TOOLS_SCENES_WIDE_GRID_H

#include <lobe/host.h>
#include <lobe/scene.h>

/// A level square around the vertical axis, of cells that are small in its middle and grow towards
/// a horizon, so that coordinates that are interpolated near the eye are exact.
typedef struct wide_grid {
    const char *name;
    uint32_t cells; ///< along each side
    /// Rows and columns are at `width` sinh(`growth` t), metres, t from -1 to 1.
    double width, growth;
    double height;         ///< metres
    double tile;           ///< metres of a unit of texture coordinates
    double middle_of_tile; ///< texture coordinates of the axis
} wide_grid;

/// Adds it with the scene's first material.
lobe_result wide_grid_add(lobe_scene *scene, const wide_grid *grid, const lobe_host *host);

#endif
