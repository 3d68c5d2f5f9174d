#ifndef TESTS_PASSES_SUPPORT_MAP_REFERENCE_H
#define TESTS_PASSES_SUPPORT_MAP_REFERENCE_H

#include <stdbool.h>

#include <lobe/scene.h>

/// Maps as shading sees them, in double precision.

/// Four channels of a texel, missing ones 0, alpha 1.
void reference_image_texel(const lobe_image *image, uint32_t x, uint32_t y, double texel[4]);

/// The value of a map at texture coordinates: with the wrapping of its use, of the nearest texel or
/// interpolated (glTF 2.0, section 3.8.4). White if the material has no such map.
void reference_map_value(const lobe_scene *scene, const lobe_texture_use *use, double u, double v,
                         double value[4]);

/// NULL where a material has no such map.
const lobe_image *image_of_map(const lobe_scene *scene, const lobe_texture_use *use);
/// The map of the lobes' widths.
const lobe_texture_use *width_map_of(const lobe_material *material);
/// Normal and factor of the width at texture coordinates.
void read_surface(const lobe_scene *scene, const lobe_material *material, double u, double v,
                  double normal[3], double width[4]);

/// The points of each texel at which passes read the maps.
typedef struct texel_points {
    uint32_t count;
    double offsets[16][2]; ///< from the texel's centre, texels
} texel_points;

texel_points texel_points_of(const lobe_scene *scene, const lobe_material *material);
/// Sixteen, where two are too few.
texel_points many_texel_points(void);

#endif
