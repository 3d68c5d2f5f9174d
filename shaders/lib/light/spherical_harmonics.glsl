#ifndef LIB_SPHERICAL_HARMONICS_GLSL
#define LIB_SPHERICAL_HARMONICS_GLSL

#include "interface/environment/irradiance_harmonics.h"
#include "lib/lobe/von_mises_fisher.glsl"

// Real spherical harmonics up to degree 2, orthonormal over the sphere: Ramamoorthi, Hanrahan,
// 2001, An Efficient Representation for Irradiance Environment Maps, Eq. 3. For a unit direction.
void spherical_harmonics(vec3 direction, out float basis[HARMONICS]) {
    vec3 d = direction;
    basis[0] = 0.282094791773878143; // sqrt(1/(4 pi))
    const float linear = 0.488602511902919921; // sqrt(3/(4 pi))
    basis[1] = linear * d.y;
    basis[2] = linear * d.z;
    basis[3] = linear * d.x;
    const float quadratic = 1.09254843059207907; // sqrt(15/(4 pi))
    basis[4] = quadratic * d.x * d.y;
    basis[5] = quadratic * d.y * d.z;
    basis[6] = 0.315391565252520002 * (3.0 * d.z * d.z - 1.0); // sqrt(5/(16 pi))
    basis[7] = quadratic * d.x * d.z;
    basis[8] = 0.5 * quadratic * (d.x * d.x - d.y * d.y);
}

// Their sum, with factors for degrees 1 and 2; with factors of 1 the irradiance of a surface with
// this unit normal: Ramamoorthi, Hanrahan, 2001, Eq. 6. Never negative: nine harmonics of a single
// light ring down to -4 % of its irradiance behind it.
vec3 harmonic_irradiance_by_degree(vec4 coefficients[HARMONICS], vec3 direction, float first,
                                   float second) {
    float basis[HARMONICS];
    spherical_harmonics(direction, basis);
    vec3 sum = basis[0] * coefficients[0].rgb;
    for (int i = 1; i < 4; ++i)
        sum += (first * basis[i]) * coefficients[i].rgb;
    for (int i = 4; i < HARMONICS; ++i)
        sum += (second * basis[i]) * coefficients[i].rgb;
    return max(sum, vec3(0.0));
}

// Degrees 1 and 2 of irradiance as homogeneous polynomials of any vector.
vec3 linear_harmonics(vec4 coefficients[HARMONICS], vec3 d) {
    const float linear = 0.488602511902919921;
    return linear * (d.y * coefficients[1].rgb + d.z * coefficients[2].rgb +
                     d.x * coefficients[3].rgb);
}

vec3 quadratic_harmonics(vec4 coefficients[HARMONICS], vec3 d) {
    const float quadratic = 1.09254843059207907;
    return quadratic * (d.x * d.y * coefficients[4].rgb + d.y * d.z * coefficients[5].rgb +
                        d.x * d.z * coefficients[7].rgb +
                        0.5 * (d.x * d.x - d.y * d.y) * coefficients[8].rgb) +
           (0.315391565252520002 * (3.0 * d.z * d.z - dot(d, d))) * coefficients[6].rgb;
}

// The part of a normal's irradiance that comes from below a horizon: the integral of
// max(<n, w>, 0) over <u, w> < 0, `up` = u. Of a normal at the angle t from u, m of them across u,
// it is of degrees 0 to 2
//   (1 - cos t)/2 E_0 + E_1(t m - (sin t - t cos t) u)/pi + (E_2(n - u) - (1 - cos t) E_2(u))/2.
// `mean_normal`: n, or shorter, of normals that vary: then cos t is their mean, which is exact for
// degree 0, and (1 - |n|^2)/2 their variance across the mean.
vec3 harmonic_irradiance_from_below(vec4 coefficients[HARMONICS], vec3 mean_normal, vec3 up) {
    float cosine = clamp(dot(mean_normal, up), -1.0, 1.0);
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0)), angle = acos(cosine);
    vec3 across = mean_normal - cosine * up;
    vec3 constant = (0.5 - 0.5 * cosine) * 0.282094791773878143 * coefficients[0].rgb;
    vec3 linear = linear_harmonics(coefficients, angle * across -
                                                     (sine - angle * cosine) * up);
    float upright = 1.0 - cosine + 0.5 * max(1.0 - dot(mean_normal, mean_normal), 0.0);
    vec3 quadratic = quadratic_harmonics(coefficients, mean_normal - up) -
                     upright * quadratic_harmonics(coefficients, up);
    return max(constant + INVERSE_PI * linear + 0.5 * quadratic, vec3(0.0));
}

// The integral of <a, w> over directions w above a horizon, <u, w> > 0, `up` = u, a of any length:
// by so much the irradiance of a surface that faces u grows as u moves by a, and it is homogeneous,
//   E(u) = |u| E_0 + E_1(u) + E_2(u)/|u|.
vec3 harmonic_light_along(vec4 coefficients[HARMONICS], vec3 a, vec3 up) {
    float cosine = dot(a, up);
    return cosine * 0.282094791773878143 * coefficients[0].rgb + linear_harmonics(coefficients, a) +
           0.5 * (quadratic_harmonics(coefficients, up + a) -
                  quadratic_harmonics(coefficients, up - a)) -
           cosine * quadratic_harmonics(coefficients, up);
}

// Mean irradiance of surfaces whose normals have the mean r mu, 0 <= r <= 1, and are distributed
// about mu as von Mises-Fisher. A convolution with such a distribution multiplies degree l by
// its own coefficient (Funk, Hecke; Ramamoorthi, Hanrahan, 2001, On the Relationship between
// Radiance and Irradiance, Eq. 21), which is the mean of the Legendre polynomial P_l(<mu, omega>):
// Mardia, Jupp, 2000, Directional Statistics, section 9.3,
//   A_1 = R(kappa) = r,   A_2 = I_{5/2}(kappa)/I_{1/2}(kappa) = 1 - 3 r/kappa.
vec3 harmonic_irradiance_of_mean_normal(vec4 coefficients[HARMONICS], vec3 mean_normal) {
    // If no direction is left, both are zero: 1e-6 avoids 0/0 in r/kappa, which tends to 1/3.
    float r = clamp(length(mean_normal), 1e-6, 1.0);
    float second = max(1.0 - 3.0 * r / concentration_from_resultant(r, 1.0 - r), 0.0);
    return harmonic_irradiance_by_degree(coefficients, mean_normal / r, r, second);
}

#endif
