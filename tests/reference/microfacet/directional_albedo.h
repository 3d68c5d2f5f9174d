#ifndef TESTS_REFERENCE_MICROFACET_DIRECTIONAL_ALBEDO_H
#define TESTS_REFERENCE_MICROFACET_DIRECTIONAL_ALBEDO_H

#include <lobe/scene.h>

/// What a microfacet surface reflects of even light from all around, in double precision and by
/// brute force; see shaders/environment/directional_albedo.comp. cosine in (0, 1], roughness in [0,
/// 1].

/// Parts of F_0 and of F_90, to 7e-5.
void reference_specular_parts(lobe_distribution distribution, double cosine, double roughness,
                              double parts[2]);

/// The mean direction that their light comes from, of length below one: tangential, away from the
/// viewer, and along the normal.
void reference_specular_directions(lobe_distribution distribution, double cosine, double roughness,
                                   double directions[2][2]);

/// Mean of (1 - <omega_i, omega_h>)^5 over cosine-weighted directions of incidence, to 1e-6.
double reference_diffuse_part(double cosine);

#endif
