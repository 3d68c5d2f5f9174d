#ifndef TESTS_PASSES_MAPS_WAVE_FIELDS_H
#define TESTS_PASSES_MAPS_WAVE_FIELDS_H

#include "tests/passes/support/fixture.h"

/// The two planes of one layer of waves (lobe/ocean.h), as a test gives them.
typedef struct wave_fields {
    lobe_texture *textures[2];
    uint32_t size; ///< texels along each side
} wave_fields;

/// `images`: square, RGBA32_FLOAT.
void wave_fields_upload(fixture *f, const lobe_image images[2], wave_fields *fields);
void wave_fields_free(wave_fields *fields);

/// What `leadr` shows of a square of 4000 periods of the waves, a white metal, under a sun with an
/// irradiance of one. `viewer` and `sun`: towards them, in the world, whose (+X, -Z, +Y) are the
/// tangent frame.
double wave_fields_seen_from(fixture *f, const lobe_material *material, wave_fields *fields,
                             const double viewer[3], const double sun[3]);

/// A plane at (x, y) texels from its corner: interpolated between the centres of texels, repeated.
void wave_field_at(const lobe_image *plane, double x, double y, double value[4]);

/// The density of a Gaussian of slopes; covariance: (xx, yy, xy).
double slope_density_at(const double slope[2], const double mean[2], const double covariance[3]);

#endif
