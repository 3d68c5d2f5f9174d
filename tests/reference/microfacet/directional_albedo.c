#include "tests/reference/microfacet/directional_albedo.h"

#include <math.h>

#include "tests/reference/lobe/base_lobe.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/vector.h"

enum { ANGLES = 240, AZIMUTHS = 96, DIFFUSE_STEPS = 400 };

/// Integrals of the parts of F_0 and of F_90: reflectance, and reflectance times the direction of
/// incidence.
typedef struct reflection {
    double sum[2], towards[2][3];
} reflection;

/// Adds what one half vector of a solid angle reflects.
static void add_half_vector(lobe_distribution distribution, double parameter,
                            const double outgoing[3], const double half_vector[3],
                            double solid_angle, reflection *parts) {
    const double normal[3] = {0, 0, 1};
    double facing = reference_dot(outgoing, half_vector);
    double incident_cosine = 2 * facing * half_vector[2] - outgoing[2];
    if (facing <= 0 || incident_cosine <= 0)
        return;
    double specular = reference_microfacet_specular(
        1, reference_normal_distribution(distribution, normal, half_vector, parameter),
        reference_masking_shadowing(distribution, incident_cosine, outgoing[2], parameter),
        outgoing[2]);
    double reflected = specular * 4 * facing * solid_angle, grazing = pow(1 - facing, 5);
    const double part[2] = {reflected * (1 - grazing), reflected * grazing};
    for (int i = 0; i < 2; i++) {
        parts->sum[i] += part[i];
        for (int k = 0; k < 3; k++)
            parts->towards[i][k] += part[i] * (2 * facing * half_vector[k] - outgoing[k]);
    }
}

// Half vectors by the angle psi with tan(theta) = alpha tan(psi), so that smooth surfaces are as
// well sampled as rough ones, crowded at both ends; by the midpoint rule.
static reflection integrate(lobe_distribution distribution, double cosine, double roughness) {
    double parameter = reference_microfacet_parameter(distribution, roughness);
    double alpha = reference_microfacet_parameter(LOBE_DISTRIBUTION_GGX, roughness);
    const double outgoing[3] = {sqrt(1 - cosine * cosine), 0, cosine};
    reflection parts = {0};
    for (int i = 0; i < ANGLES; i++) {
        double t = (i + 0.5) / ANGLES;
        double psi = M_PI / 2 * (t * t * t * (10 - 15 * t + 6 * t * t));
        double step = M_PI / 2 * (30 * t * t * (1 - t) * (1 - t)) / ANGLES;
        double theta = atan(alpha * tan(psi));
        double scale = alpha / (pow(cos(psi), 2) + pow(alpha * sin(psi), 2));
        for (int j = 0; j < AZIMUTHS; j++) {
            double azimuth = M_PI * (j + 0.5) / AZIMUTHS;
            const double half_vector[3] = {sin(theta) * cos(azimuth), sin(theta) * sin(azimuth),
                                           cos(theta)};
            add_half_vector(distribution, parameter, outgoing, half_vector,
                            sin(theta) * scale * step * 2 * M_PI / AZIMUTHS, &parts);
        }
    }
    return parts;
}

void reference_specular_parts(lobe_distribution distribution, double cosine, double roughness,
                              double parts[2]) {
    reflection whole = integrate(distribution, cosine, roughness);
    for (int i = 0; i < 2; i++)
        parts[i] = whole.sum[i];
}

void reference_specular_directions(lobe_distribution distribution, double cosine, double roughness,
                                   double directions[2][2]) {
    reflection whole = integrate(distribution, cosine, roughness);
    for (int i = 0; i < 2; i++) {
        directions[i][0] = -whole.towards[i][0] / whole.sum[i];
        directions[i][1] = whole.towards[i][2] / whole.sum[i];
    }
}

double reference_diffuse_part(double cosine) {
    double sum = 0;
    for (int i = 0; i < DIFFUSE_STEPS; i++) {
        double theta = M_PI / 2 * (i + 0.5) / DIFFUSE_STEPS;
        for (int j = 0; j < DIFFUSE_STEPS; j++) {
            double azimuth = M_PI * (j + 0.5) / DIFFUSE_STEPS;
            double between =
                sin(theta) * cos(azimuth) * sqrt(1 - cosine * cosine) + cos(theta) * cosine;
            sum += 2 * sin(theta) * cos(theta) * pow(1 - cos(acos(fmin(between, 1)) / 2), 5);
        }
    }
    return sum * M_PI / 2 / DIFFUSE_STEPS / DIFFUSE_STEPS;
}
