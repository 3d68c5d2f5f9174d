#ifndef TESTS_PASSES_FILTERS_DISPLACED_RELIEF_PLANE_H
#define TESTS_PASSES_FILTERS_DISPLACED_RELIEF_PLANE_H

#include "tests/passes/support/fixture.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

/// A plane that a relief covers, of which a picture sees all texels, many times. Directions are in
/// the tangent frame: x along columns, y against rows.

/// Heights in widths of a texel, of a map that repeats.
typedef double (*relief_height)(uint32_t column, uint32_t row);
/// A map of `width` x `height` texels for relief_plane, of heights between -512 and 512.
lobe_image relief_map(uint32_t width, uint32_t height, relief_height height_at);
/// What such a map holds in red for a height.
float relief_map_value(double height);
/// The height that such a map has at a texel, which may lie beyond its first period.
double relief_map_height(const lobe_image *map, uint32_t column, uint32_t row);

/// Lambert's material, of this albedo: half-vector lobes of no colour.
lobe_material relief_material(double albedo);

/// The plane of a material with heights `map`, `tiles` times along the picture, from `outgoing`.
/// Without a light.
lobe_scene *relief_plane(const lobe_material *material, lobe_image map, const double outgoing[3],
                         double tiles);
void relief_plane_add_sun(lobe_scene *scene, const double incoming[3], double irradiance);
/// Radiance 1 from above.
void relief_plane_add_sky(lobe_scene *scene);

/// The mean of a picture's red, green and blue, of so many samples in all, at least 64.
void relief_plane_draw_colour(fixture *f, lobe_scene *scene, const char *filter,
                              const char *setting, uint32_t samples, double mean[3]);
/// The same of its green.
double relief_plane_draw(fixture *f, lobe_scene *scene, const char *filter, const char *setting,
                         uint32_t samples);

#endif
