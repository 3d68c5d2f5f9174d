#ifndef PASSES_FILTERS_DISPLACED_RELIEF_H
#define PASSES_FILTERS_DISPLACED_RELIEF_H

#include "passes/context/filter.h"
#include "shaders/interface/displacement/relief.h"

/// The relief of a material with a height map, see shaders/interface/displacement/relief.h.
typedef struct relief {
    struct height_field_constants constants;
    lobe_resource block;   ///< of the constants
    lobe_resource heights; ///< the map
    lobe_resource maxima;
    lobe_resource extent;
    uint64_t bytes; ///< of the maxima
} relief;

/// Of the buffer `extent`.
#define HEIGHT_EXTENT_BYTES (4 * (uint32_t)sizeof(float))

/// Whether the material has a relief.
bool passes_has_relief(const device_material *material);

/// Adds the passes that make the relief of a material that has one: height_rows, height_extent,
/// height_maxima. They run when the map or its scale changes. `retained`: passes of every frame
/// read it.
relief passes_relief(const filter_context *context, uint32_t material, bool retained);

/// Binds what shaders/filters/displaced/height_field.glsl reads.
void passes_relief_read(const relief *relief, lobe_pass *pass);

/// The same for shading. NULL: a shader that reads no relief.
void passes_relief_bind(const relief *drawn, const filter_context *context,
                        filtered_appearance *appearance);

#endif
