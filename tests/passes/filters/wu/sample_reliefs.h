#ifndef TESTS_PASSES_FILTERS_WU_SAMPLE_RELIEFS_H
#define TESTS_PASSES_FILTERS_WU_SAMPLE_RELIEFS_H

#include <lobe/host.h>
#include <lobe/image.h>

/// Reliefs to measure filters on that no constant of a filter was found on. RGBA32_FLOAT maps that
/// repeat, heights in texels' widths in red. Free with lobe_image_free.

enum { SAMPLE_EXTENT = 256 };

/// Threads of 16 texels in a twill of two over two.
lobe_image sample_relief_twill(void);
/// Half spheres of 9 to 19 texels at random places.
lobe_image sample_relief_bumps(uint64_t seed);
/// Gaussian noise whose waves are about `wavelength` texels long, with slopes of rms 1.
lobe_image sample_relief_noise(uint32_t extent, double wavelength, uint64_t seed);
/// A file (OpenEXR, PNG, JPEG), reduced by its own mean to SAMPLE_EXTENT, whose slopes have an rms
/// of 1. Asserts that it can be read.
lobe_image sample_relief_load(const char *path, const lobe_host *host);

/// Moves and scales heights to [0, 1]. Returns by how much they differed.
double sample_relief_normalise(lobe_image *map);

/// Scales heights to slopes of this rms.
void sample_relief_scale(const lobe_image *map, double slope);

/// The rms of a relief's slopes.
double sample_relief_slope(const lobe_image *map);

#endif
