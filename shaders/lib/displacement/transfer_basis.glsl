#ifndef LIB_TRANSFER_BASIS_GLSL
#define LIB_TRANSFER_BASIS_GLSL

#include "lib/number/constants.glsl"

// Functions y_k of directions over the upper hemisphere: z times polynomials of degree 1 (the first
// four) and 2 (all nine), orthonormal over solid angles. The first is proportional to the cosine;
// the integral of the cosine's square over the hemisphere is 2 pi / 3.
//
// By Gram and Schmidt, from integrals of z^n, 2 pi / (n + 1).
const int TRANSFER_FUNCTIONS = 9;

const float TRANSFER_SCALE[9] =
    float[9](sqrt(3.0 / (2.0 * PI)), sqrt(15.0 / (2.0 * PI)), sqrt(15.0 / (2.0 * PI)),
             sqrt(40.0 / PI), sqrt(105.0 / (2.0 * PI)), sqrt(3360.0 / (17.0 * PI)),
             sqrt(3360.0 / (17.0 * PI)), sqrt(105.0 / (8.0 * PI)), sqrt(1575.0 / (2.0 * PI)));

// Their integrals over the hemisphere.
const float TRANSFER_INTEGRAL[9] =
    float[9](sqrt(3.0 * PI / 2.0), 0.0, 0.0, -sqrt(40.0 * PI) / 12.0, 0.0, 0.0, 0.0, 0.0,
             sqrt(1575.0 * PI / 2.0) / 90.0);

// The cosine's coefficient in the first function; it has none in the others.
const float TRANSFER_COSINE = sqrt(2.0 * PI / 3.0);

// All functions of a direction; 0 below the horizon.
void transfer_functions(vec3 d, out float y[9]) {
    float z = max(d.z, 0.0);
    y[0] = z;
    y[1] = z * d.x;
    y[2] = z * d.y;
    y[3] = z * (z - 0.75);
    y[4] = z * d.x * d.y;
    y[5] = z * d.x * (z - 0.625);
    y[6] = z * d.y * (z - 0.625);
    y[7] = z * (d.x * d.x - d.y * d.y);
    y[8] = z * (z * (z - 4.0 / 3.0) + 0.4);
    for (int k = 0; k < 9; ++k)
        y[k] *= TRANSFER_SCALE[k];
}

// Integrals over elevations, of one azimuth, of the functions times the cosine to a facet's normal:
// b += width of the azimuth times these. `slope`: tangent of the elevation, at least 0, above which
// the sky is seen; `along`: the horizontal direction (x, y); `towards`: its product with the
// normal; `up`: z of the normal.
//
// With s the sine of the elevation and c its cosine, the integrand is y (towards c + up s) ds:
// polynomials of s, and these times c.
void add_transfer_of_azimuth(float slope, vec2 along, float towards, float up, float width,
                             inout float b[9]) {
    float c = inversesqrt(1.0 + slope * slope), e = min(slope * c, 1.0), e2 = e * e;
    float i1 = 0.5 * (1.0 - e2), i2 = (1.0 - e2 * e) / 3.0, i3 = 0.25 * (1.0 - e2 * e2),
          i4 = (1.0 - e2 * e2 * e) / 5.0;
    float c3 = c * c * c;
    float j1 = c3 / 3.0, j3 = c3 * (1.0 / 3.0 - c * c / 5.0);
    float j2 = 0.125 * (atan(c, e) + e * c * (1.0 - 2.0 * e2));
    float s1 = towards * j1 + up * i2, s2 = towards * j2 + up * i3, s3 = towards * j3 + up * i4;
    float sc = towards * (i1 - i3) + up * j2, ssc = towards * (i2 - i4) + up * j3;
    float scc = towards * (j1 - j3) + up * (i2 - i4);
    float terms[9];
    terms[0] = s1;
    terms[1] = sc * along.x;
    terms[2] = sc * along.y;
    terms[3] = s2 - 0.75 * s1;
    terms[4] = scc * along.x * along.y;
    terms[5] = (ssc - 0.625 * sc) * along.x;
    terms[6] = (ssc - 0.625 * sc) * along.y;
    terms[7] = scc * (along.x * along.x - along.y * along.y);
    terms[8] = s3 - 4.0 / 3.0 * s2 + 0.4 * s1;
    for (int k = 0; k < 9; ++k)
        b[k] += width * TRANSFER_SCALE[k] * terms[k];
}

#endif
