#ifndef TESTS_PASSES_SUPPORT_SCENE_BUILDER_H
#define TESTS_PASSES_SUPPORT_SCENE_BUILDER_H

#include <lobe/scene.h>

/// Small scenes made for one test. All functions abort if memory runs out.

/// No light, no camera; destroyed with lobe_scene_destroy.
lobe_scene *scene_begin(void);

/// Zeroed texels.
lobe_image map_image(lobe_format format, uint32_t width, uint32_t height);
/// RGBA32_FLOAT texels, all with the same values.
lobe_image constant_map(uint32_t width, uint32_t height, float r, float g, float b);
/// RGBA32_FLOAT normals at random, up to `tilt` radians from the pole.
lobe_image random_normal_map(uint32_t width, uint32_t height, double tilt, uint64_t seed);
/// RGBA32_FLOAT values in [low, high).
lobe_image random_map(uint32_t width, uint32_t height, double low, double high, uint64_t seed);

/// Moves the image into the scene and says how to use it: repeated, the first texture coordinates.
lobe_texture_use scene_add_map(lobe_scene *scene, lobe_image image);

/// A square around the origin, 2 m wide, that faces up (+Y). Texture coordinates run from 0 to
/// `tiles` along +X and +Z; so the tangent frame is (+X, -Z, +Y). `transform`: NULL for none.
void scene_add_square(lobe_scene *scene, const lobe_material *material, double tiles,
                      const float transform[16]);
/// A dielectric one with random normals, and above a part of it another, whose mask has holes.
void scene_add_masked_squares(lobe_scene *scene, double tiles);

/// A sphere around the origin of radius 1 m, with `tiles` of texture coordinates from pole to pole.
void scene_add_sphere(lobe_scene *scene, const lobe_material *material, double tiles);

/// A directional light; `towards` need not be of unit length.
void scene_add_sun(lobe_scene *scene, const double towards[3], double intensity);

/// Light from all around: an image of latitude and longitude (RGBA32_FLOAT), which the scene owns
/// from then on.
void scene_set_environment(lobe_scene *scene, lobe_image image);
/// The radiance of a direction of the environment's space.
typedef void (*environment_radiance)(const double direction[3], float radiance[3]);
/// The same, of `height` rows and twice as many columns.
void scene_surround(lobe_scene *scene, uint32_t height, environment_radiance radiance);

/// An orthographic camera straight above the origin: x to the right, z down. A square picture
/// shows `height` metres.
void scene_look_down(lobe_scene *scene, double height);
/// The same from another side: `towards` points from the origin to the viewer.
void scene_look_from(lobe_scene *scene, const double towards[3], double height);
/// A square of scene_add_square seen both near and far, under two suns.
void scene_look_along(lobe_scene *scene);

/// Sets the bounds; the last step.
void scene_end(lobe_scene *scene);
/// The last steps for a scene of one square with one copy of its maps, which fills the picture.
void scene_end_with_square(lobe_scene *scene, const lobe_material *material);

/// A half-vector material with one white lobe along the normal and no diffuse part.
lobe_material half_vector_material(lobe_distribution distribution, float width);
/// A white microfacet material.
lobe_material microfacet_material(lobe_distribution distribution, double roughness,
                                  double metallic);

#endif
