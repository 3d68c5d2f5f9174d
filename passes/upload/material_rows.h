#ifndef PASSES_UPLOAD_MATERIAL_ROWS_H
#define PASSES_UPLOAD_MATERIAL_ROWS_H

#include "passes/upload/device_scene.h"

/// Rows of a material's lobe_grid on the host, for scans of all texels. A texel takes about 4 ns,
/// an eighth of what passes_material_lobes_read takes for its lobes.
typedef struct material_rows {
    const lobe_image *normals, *widths; ///< NULL: the material has no such map
    uint32_t width, height;             ///< of the grid, texels
    lobe_normal_encoding encoding;
    float normal_scale;
    uint32_t factor_channel; ///< of the width map
    float *normal[3];        ///< of the row that was read: unit, in the tangent frame
    float *factor;           ///< of the row that was read: of the base lobes' widths
    float *texels;           ///< of a map with another width
    float data[];
} material_rows;

/// Whether the host can read the formats of the material's normal and width map.
bool passes_material_rows_are_readable(const device_material *material);

/// For a material whose rows are readable. NULL: out of memory. Freed with lobe_release.
material_rows *passes_material_rows_create(const lobe_allocator *allocator,
                                           const device_material *material);

/// Reads row `y` of the grid: normals and factors as passes_material_lobes_read has them.
void passes_material_row_read(material_rows *rows, uint32_t y);

#endif
