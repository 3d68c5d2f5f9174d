#ifndef PASSES_MAPS_SURFACE_ATLAS_H
#define PASSES_MAPS_SURFACE_ATLAS_H

#include "passes/context/filter.h"

/// The surface frame of an instance's mesh over its own texture coordinates, in object space.
typedef struct surface_atlas {
    lobe_resource normal;   ///< RGBA32_FLOAT: unit normal, coverage
    lobe_resource tangent;  ///< RGBA32_FLOAT: unit tangent, handedness
    lobe_resource position; ///< RGBA32_FLOAT: position
} surface_atlas;

/// Adds the raster pass that draws the atlas with `width` x `height` texels. The images are
/// retained, so that it runs only when the mesh changes. Texture coordinates are those of the
/// material's lobe_grid (see device_instance.is_atlas).
surface_atlas passes_surface_atlas_draw(const filter_context *context, size_t instance,
                                        uint32_t width, uint32_t height);

#endif
