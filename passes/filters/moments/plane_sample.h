#ifndef PASSES_FILTERS_MOMENTS_PLANE_SAMPLE_H
#define PASSES_FILTERS_MOMENTS_PLANE_SAMPLE_H

#include "passes/upload/material_lobes.h"

/// A base lobe in the Lambert plane (shaders/lib/lobe/lambert_plane.glsl, plane_lobe.glsl).
typedef struct plane_sample {
    double place[2], variance, mass;
    double weight;              ///< of all lobes that it stands for; relative to other samples
    double specular[3];         ///< what it reflects, linear RGB
    double albedo[3], metallic; ///< of its texel
} plane_sample;

/// The lobes at a point of a material's lobe_grid (in texels), with this weight in all; returns
/// their number, 0 if the host cannot read a map of lobes. Colours are those of the texel; where
/// the host cannot read them, white.
uint32_t passes_plane_samples_read(const lobe_scene *scene, const device_material *material,
                                   double x, double y, double weight,
                                   plane_sample samples[LOBE_MATERIAL_MAXIMUM_LOBES]);

/// The mass of a GGX lobe of this concentration (plane_mass in shaders/lib/lobe/plane_lobe.glsl).
double passes_plane_mass_of_ggx(double concentration);

/// The variance of a material's lobe of this concentration.
double passes_plane_variance(const lobe_material *material, double concentration);

/// Sums of samples: weight, place, second moments of the place (xx, yy, xy), and variance.
typedef struct plane_sums {
    double weight, place[2], moments[3], variance;
} plane_sums;

void passes_plane_sums_add(plane_sums *sums, const plane_sample *sample, double weight);
/// The covariance (xx, yy, xy) of the places about their mean; the weight is above 0.
void passes_plane_sums_covariance(const plane_sums *sums, double covariance[3]);

/// The covariance (xx, yy, xy) at a place of a variance of one about it, and its inverse.
void passes_plane_distortion(const double place[2], double covariance[3], double inverse[3]);

#endif
