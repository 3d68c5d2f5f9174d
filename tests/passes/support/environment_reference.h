#ifndef TESTS_PASSES_SUPPORT_ENVIRONMENT_REFERENCE_H
#define TESTS_PASSES_SUPPORT_ENVIRONMENT_REFERENCE_H

#include <lobe/environment_maps.h>

#include "tests/passes/support/fixture.h"

/// Environments for tests, and what their maps should be, in double precision.

/// An environment of one colour; free its image with lobe_image_free.
lobe_environment environment_of_colour(lobe_environment_layout layout, uint32_t width,
                                       uint32_t height, const float colour[3]);
float *environment_texel(const lobe_environment *environment, uint32_t x, uint32_t y);
/// Smooth, with a bright patch, and different in every direction.
lobe_environment environment_of_patches(uint32_t width, uint32_t height);

/// Makes maps; asserts success.
lobe_environment_maps *make_maps(fixture *f, const lobe_environment *environment, uint32_t size,
                                 bool lobes, bool ggx);

/// A cube on the host.
typedef struct host_cube {
    uint32_t width, levels;
    lobe_image faces[12][6]; ///< by level
} host_cube;

host_cube read_cube(lobe_environment_maps *maps, lobe_environment_map map);
void free_cube(host_cube *cube);
const float *cube_texel(const host_cube *cube, uint32_t level, int face, int x, int y);
/// Sum over a level of radiance times solid angle, by channel.
void cube_energy(const host_cube *cube, uint32_t level, double energy[3]);
/// What a sampler reads: linear interpolation that continues across edges; at a corner, where only
/// three texels meet, their mean is the fourth.
void cube_fetch(const host_cube *cube, uint32_t level, const double direction[3], double value[3]);

/// The lobes that filtered cubes are made with, normalised over the sphere; x = 1 - cos theta.
double reference_vmf_lobe(double x, double concentration);
double reference_ggx_lobe(double x, double concentration);
typedef double (*reference_lobe)(double x, double concentration);

/// The exact light of a lobe: the sum over all texels of level 0 of the radiance.
void exact_light(const host_cube *radiance, const double direction[3], reference_lobe lobe,
                 double concentration, double value[3]);

#endif
