#ifndef TESTS_REFERENCE_MICROFACET_H
#define TESTS_REFERENCE_MICROFACET_H

#include <lobe/scene.h>

/// The microfacet frame in double precision; see shaders/lib/microfacet/normal_distribution.glsl,
/// masking.glsl, fresnel.glsl and microfacet.glsl. Directions of unit length; a parameter as in
/// base_lobe.h.

/// D(h): per steradian; integral over the hemisphere of D <n, h> is 1.
double reference_normal_distribution(lobe_distribution distribution, const double normal[3],
                                     const double half_vector[3], double parameter);

/// Projected area of a von Mises-Fisher lobe above the horizon of its own axis.
double reference_von_mises_fisher_projected_area(double kappa);

/// Smith's Lambda, G1 and height-correlated G2, for cosines to the normal.
double reference_smith_lambda(lobe_distribution distribution, double cosine, double parameter);
double reference_masking(lobe_distribution distribution, double cosine, double parameter);
double reference_masking_shadowing(lobe_distribution distribution, double incident_cosine,
                                   double outgoing_cosine, double parameter);

/// Schlick's F of one channel.
double reference_fresnel(double f0, double f90, double cosine);

/// F D G2 / (4 cos_o), the incident cosine included, of one channel.
double reference_microfacet_specular(double fresnel, double distribution, double masking_shadowing,
                                     double outgoing_cosine);
/// albedo / pi (1 - F) cos_i of one channel.
double reference_microfacet_diffuse(double albedo, double fresnel, double incident_cosine);

#endif
