#include "passes/filters/lobes/lobe_shapes.h"

#include <math.h>

/// More of a lobe than this lies too far from its axis to be drawn.
static const double drawn_part = 0.999;

bool passes_lobes_keep_shape(const lobe_material *material) {
    return material->model == LOBE_MATERIAL_MICROFACET &&
           material->distribution != LOBE_DISTRIBUTION_VMF;
}

static double difference_squared(const double a[3], const double b[3]) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

double passes_lobe_von_mises_fisher(const double axis[3], double concentration,
                                    const double direction[3]) {
    const double kappa = fmax(concentration, 1e-20);
    return kappa / (-2 * M_PI * expm1(-2 * kappa)) *
           exp(-0.5 * kappa * difference_squared(axis, direction));
}

double passes_lobe_projected_area(double concentration) {
    return 0.5 * (1 + passes_mean_resultant_length(0.5 * concentration)) /
           (1 + exp(-concentration));
}

/// Xu et al. 2017, Eq. 8, and Newton's method.
double passes_lobe_concentration(double mean_resultant_length) {
    const double r = fmin(mean_resultant_length, 1 - 1e-7);
    double kappa = r * (3 - r * r) / (1 - r * r);
    for (int i = 0; i < 3 && kappa > 1e-3; i++) {
        const double sinh_kappa = sinh(fmin(kappa, 300));
        kappa -= (passes_mean_resultant_length(kappa) - r) /
                 (1 / (kappa * kappa) - 1 / (sinh_kappa * sinh_kappa));
    }
    return kappa;
}

double passes_lobe_of_microfacets(lobe_distribution distribution, const double axis[3],
                                  double concentration, const double direction[3]) {
    const double kappa = fmax(concentration, 1e-3);
    const double sine = 0.25 * difference_squared(axis, direction); // squared, of half the angle
    const double cosine = 1 - 2 * sine, square = cosine * cosine;
    if (cosine <= 0)
        return 0;
    // The squares of the tangent and of 1 / alpha.
    const double tangent = 4 * sine * (1 - sine) / square, scale = 0.5 * kappa;
    if (distribution == LOBE_DISTRIBUTION_BECKMANN)
        return scale * exp(-scale * tangent) / (M_PI * square * square);
    if (distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return (kappa + 1) / (2 * M_PI) * pow(cosine, fmax(kappa - 1, 0));
    const double tail = 1 + scale * tangent;
    return scale / (M_PI * square * square * tail * tail);
}

double passes_lobe_of_base(const lobe_material *material, const material_lobe *lobe,
                           const double direction[3]) {
    const double kappa = lobe->concentration;
    if (passes_lobes_keep_shape(material))
        return passes_lobe_of_microfacets(material->distribution, lobe->axis, kappa, direction);
    const double value = passes_lobe_von_mises_fisher(lobe->axis, kappa, direction);
    return material->model == LOBE_MATERIAL_MICROFACET ? value / passes_lobe_projected_area(kappa)
                                                       : value;
}

/// The cosine between a drawn direction and the axis. By the inverses of the distributions, for a
/// von Mises-Fisher lobe that of a narrow one.
static double drawn_cosine(const lobe_material *material, double concentration, double part) {
    const double kappa = fmax(concentration, 1), rest = -log1p(-part);
    if (!passes_lobes_keep_shape(material) ||
        material->distribution == LOBE_DISTRIBUTION_BLINN_PHONG)
        return fmax(1 - rest / kappa, -1);
    const double ggx = part / (1 - part);
    const double tangent =
        2 / kappa * (material->distribution == LOBE_DISTRIBUTION_BECKMANN ? rest : ggx);
    return 1 / sqrt(1 + tangent);
}

void passes_lobe_draw(const lobe_material *material, const material_lobe *lobe,
                      const float position[2], double direction[3]) {
    const double angle = 2 * M_PI * (double)position[1];
    const double cosine =
        drawn_cosine(material, lobe->concentration, drawn_part * (double)position[0]);
    const double sine = sqrt(fmax(1 - cosine * cosine, 0));
    const double local[3] = {sine * cos(angle), sine * sin(angle), cosine};
    passes_material_lobe_rotate(lobe->axis, local, direction);
}
