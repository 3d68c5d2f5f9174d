#ifndef TESTS_PASSES_SUPPORT_SLOPE_PLANE_H
#define TESTS_PASSES_SUPPORT_SLOPE_PLANE_H

#include "tests/passes/support/fixture.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

/// A plane of which one pixel sees all texels of a normal map, many times, each a flat facet. Tests
/// how a filter shades the means of the whole map, from any direction and under any light.
/// Directions are in the tangent frame.

/// Normals about a tilted one, in a map of 8 x 8 texels.
lobe_image slope_plane_leaning_map(uint64_t seed);
/// Slopes at random, Gaussian with a standard deviation of `slope`, in a square map.
lobe_image slope_plane_bumpy_map(uint32_t extent, double slope);
/// The unit normal of one of its texels.
void slope_plane_bumpy_normal(uint32_t texel, double slope, double normal[3]);
/// The mean radiance of its texels under a sun of irradiance 1, green.
double slope_plane_bumpy_radiance(const lobe_material *material, uint32_t extent, double slope,
                                  const double outgoing[3], const double incoming[3]);

void slope_plane_direction(double degrees, double azimuth, double direction[3]);

/// The plane of a material with a copy of `normals`, seen from `outgoing`, without a light.
/// `mapped` receives the material with its map.
lobe_scene *slope_plane(const lobe_material *material, const lobe_image *normals,
                        const double outgoing[3], lobe_material *mapped);
void slope_plane_add_sun(lobe_scene *scene, const double incoming[3], double intensity);

/// Draws the pixel with one more assignment, or NULL.
void slope_plane_draw(fixture *f, lobe_scene *scene, const char *filter, const char *setting,
                      float colour[3]);
/// The same of a plane under one sun.
void slope_plane_draw_lit(fixture *f, const lobe_material *material, const lobe_image *normals,
                          const char *filter, const char *setting, const double outgoing[3],
                          const double incoming[3], float colour[3]);

/// Angles from upright, in degrees, and one viewer and one light for each of the 16 pairs of them,
/// in different planes: that of the light changes first.
extern const double slope_plane_angles[4];
void slope_plane_pair(int pair, double outgoing[3], double incoming[3]);

/// The fraction of uniform light that is reflected to the viewer, who is `degrees` from upright.
double slope_plane_furnace(fixture *f, const lobe_material *material, const lobe_image *normals,
                           const char *filter, const char *setting, double degrees);

#endif
