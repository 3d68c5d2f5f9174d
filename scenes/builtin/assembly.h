#ifndef SCENES_BUILTIN_ASSEMBLY_H
#define SCENES_BUILTIN_ASSEMBLY_H

#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Helpers for building scenes in code.

/// One step of building: adds its part to the scene.
typedef lobe_result (*builtin_step)(lobe_scene *scene, const lobe_host *host);

/// Runs the steps, an array that ends with NULL, on an empty scene, and completes it.
lobe_result scenes_builtin_assemble(const char *name, const builtin_step *steps,
                                    const lobe_host *host, lobe_scene **scene);

/// A map that is computed texel by texel.
typedef struct builtin_map {
    const char *name;
    lobe_format format;
    uint32_t width, height; ///< texels
    void (*fill)(uint32_t column, uint32_t row, void *texel);
} builtin_map;

/// Adds the map to the scene's images. On failure `*index` is -1.
lobe_result scenes_builtin_add_map(lobe_scene *scene, const builtin_map *map, const lobe_host *host,
                                   int32_t *index);

/// Adds a GGX microfacet material with three maps: normals, base colours, and a map with roughness
/// in green and metallic in blue.
lobe_result scenes_builtin_add_metal_rough(lobe_scene *scene, const char *name,
                                           const builtin_map *normals, const builtin_map *colours,
                                           const builtin_map *roughness, const lobe_host *host);

/// Stores a normal (any length above 0, z > 0) as an RGBA8_UNORM texel of a +Y normal map:
/// RGB = (n + 1) / 2 of the unit normal, x to the right and y up in the image, alpha 1.
void scenes_normal_map_store(uint8_t texel[4], double x, double y, double z);

/// Stores the normal of a height field with these derivatives along the columns (to the right) and
/// along the rows (downwards), in the units of the height.
void scenes_normal_map_store_slope(uint8_t texel[4], double along_column, double along_row);

#endif
