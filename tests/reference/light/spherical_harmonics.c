#include "tests/reference/light/spherical_harmonics.h"

#include <math.h>
#include <stddef.h>

#include "tests/reference/light/cube_texel.h"

// Associated Legendre function without its sign (-1)^order, by the usual recurrence in the degree.
static double legendre(int degree, int order, double z) {
    double last = 0, current = 1;
    for (int i = 1; i <= order; i++)
        current *= (2 * i - 1) * sqrt(fmax(1 - z * z, 0));
    for (int l = order + 1; l <= degree; l++) {
        double next = ((2 * l - 1) * z * current - (l + order - 1) * last) / (l - order);
        last = current;
        current = next;
    }
    return current;
}

double reference_spherical_harmonic(int degree, int order, const double direction[3]) {
    int m = order < 0 ? -order : order;
    double ratio = 1;
    for (int i = degree - m + 1; i <= degree + m; i++)
        ratio /= i;
    double norm = sqrt((2 * degree + 1) / (4 * M_PI) * ratio * (m ? 2 : 1));
    double azimuth = atan2(direction[1], direction[0]);
    return norm * legendre(degree, m, direction[2]) *
           (order < 0 ? sin(m * azimuth) : cos(m * azimuth));
}

double reference_harmonic_sum(const double coefficients[REFERENCE_HARMONICS],
                              const double direction[3]) {
    double sum = 0;
    for (int degree = 0; degree < 3; degree++)
        for (int order = -degree; order <= degree; order++)
            sum += coefficients[degree * (degree + 1) + order] *
                   reference_spherical_harmonic(degree, order, direction);
    return sum;
}

void reference_add_irradiance(const double direction[3], double power,
                              double coefficients[REFERENCE_HARMONICS]) {
    static const double cosine_factor[3] = {M_PI, 2 * M_PI / 3, M_PI / 4};
    for (int degree = 0; degree < 3; degree++)
        for (int order = -degree; order <= degree; order++)
            coefficients[degree * (degree + 1) + order] +=
                power * cosine_factor[degree] *
                reference_spherical_harmonic(degree, order, direction);
}

void reference_irradiance_of_cube(const float *texels, int size, int channel,
                                  double coefficients[REFERENCE_HARMONICS]) {
    for (int i = 0; i < REFERENCE_HARMONICS; i++)
        coefficients[i] = 0;
    for (int i = 0; i < 6 * size * size; i++) {
        double direction[3];
        int x = i % size, y = i / size % size;
        reference_cube_texel_direction(i / (size * size), x, y, size, direction);
        double radiance = (double)texels[(size_t)4 * i + channel];
        reference_add_irradiance(direction, radiance * reference_cube_texel_solid_angle(x, y, size),
                                 coefficients);
    }
}
