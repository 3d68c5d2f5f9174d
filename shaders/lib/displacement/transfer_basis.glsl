#ifndef LIB_TRANSFER_BASIS_GLSL
#define LIB_TRANSFER_BASIS_GLSL

#include "lib/number/constants.glsl"

// Polynomials of directions over the upper hemisphere: z times polynomials of degree 3 and less,
// orthonormal over solid angles. The first is proportional to the cosine; the integral of the
// cosine's square over the hemisphere is 2 pi / 3.
//
// By Gram and Schmidt, for each number of periods around the pole, from integrals of
// z^n (1 - z^2)^m.
const int TRANSFER_POLYNOMIALS = 16;

const float TRANSFER_SCALE[16] = float[16](
    sqrt(3.0 / (2.0 * PI)), sqrt(15.0 / (2.0 * PI)), sqrt(15.0 / (2.0 * PI)), sqrt(40.0 / PI),
    sqrt(105.0 / (2.0 * PI)), sqrt(3360.0 / (17.0 * PI)), sqrt(3360.0 / (17.0 * PI)),
    sqrt(105.0 / (8.0 * PI)), sqrt(1575.0 / (2.0 * PI)), sqrt(315.0 / (16.0 * PI)),
    sqrt(315.0 / (16.0 * PI)), sqrt(645120.0 / (421.0 * PI)), sqrt(161280.0 / (421.0 * PI)),
    sqrt(74970.0 / (19.0 * PI)), sqrt(74970.0 / (19.0 * PI)), sqrt(14112.0 / PI));

// Their integrals over the hemisphere.
const float TRANSFER_INTEGRAL[16] =
    float[16](sqrt(3.0 * PI / 2.0), 0.0, 0.0, -sqrt(40.0 * PI) / 12.0, 0.0, 0.0, 0.0, 0.0,
              sqrt(1575.0 * PI / 2.0) / 90.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
              -sqrt(14112.0 * PI) / 560.0);

// The cosine's coefficient in the first polynomial; it has none in the others.
const float TRANSFER_COSINE = sqrt(2.0 * PI / 3.0);

// Scaled sums of what depends on the height alone: z z^p c^q, where c is the distance from the pole
// and q the number of periods, times what depends on the azimuth.
void assemble_polynomials(float none[4], float one[3], float two[2], float three, vec2 along,
                          out float y[16]) {
    float product = along.x * along.y, difference = along.x * along.x - along.y * along.y;
    float second = one[1] - 0.625 * one[0];
    float third = one[2] - 20.0 / 17.0 * one[1] + 73.0 / 238.0 * one[0];
    float next = two[1] - 35.0 / 64.0 * two[0];
    y[0] = none[0];
    y[1] = one[0] * along.x;
    y[2] = one[0] * along.y;
    y[3] = none[1] - 0.75 * none[0];
    y[4] = two[0] * product;
    y[5] = second * along.x;
    y[6] = second * along.y;
    y[7] = two[0] * difference;
    y[8] = none[2] - 4.0 / 3.0 * none[1] + 0.4 * none[0];
    y[9] = three * along.x * (difference - 2.0 * along.y * along.y);
    y[10] = three * along.y * (difference + 2.0 * along.x * along.x);
    y[11] = next * product;
    y[12] = next * difference;
    y[13] = third * along.x;
    y[14] = third * along.y;
    y[15] = none[3] - 1.875 * none[2] + 15.0 / 14.0 * none[1] - 5.0 / 28.0 * none[0];
    for (int k = 0; k < 16; ++k)
        y[k] *= TRANSFER_SCALE[k];
}

// All polynomials of a direction; 0 below the horizon.
void transfer_polynomials(vec3 d, out float y[16]) {
    float z = max(d.z, 0.0);
    assemble_polynomials(float[4](z, z * z, z * z * z, z * z * z * z),
                         float[3](z, z * z, z * z * z), float[2](z, z * z), z, d.xy, y);
}

// The same over z as sums of 16 products of coordinates, which take fewer operations to find: for
// sums of polynomials over z whose factors were turned into such products' by transfer_products.
void transfer_terms(vec3 d, out vec4 terms[4]) {
    float difference = d.x * d.x - d.y * d.y;
    vec3 pairs = d.xxy * d.yzz;
    float square = d.z * d.z;
    terms[0] = vec4(1.0, d);
    terms[1] = vec4(pairs, difference);
    terms[2] = vec4(square, d.x * (difference - 2.0 * d.y * d.y),
                    d.y * (difference + 2.0 * d.x * d.x), pairs.x * d.z);
    terms[3] = vec4(difference, square * d) * vec4(d.z, 1.0, 1.0, 1.0);
}

// `factors`: of the polynomials.
void transfer_products(inout vec4 factors[4]) {
    for (int i = 0; i < 4; ++i)
        factors[i] *= vec4(TRANSFER_SCALE[4 * i], TRANSFER_SCALE[4 * i + 1],
                           TRANSFER_SCALE[4 * i + 2], TRANSFER_SCALE[4 * i + 3]);
    vec4 third = factors[3];
    factors[0] += vec4(0.4 * factors[2].x - 0.75 * factors[0].w - 5.0 / 28.0 * third.w,
                       73.0 / 238.0 * third.yz - 0.625 * factors[1].yz,
                       15.0 / 14.0 * third.w - 4.0 / 3.0 * factors[2].x);
    factors[1] -= vec4(35.0 / 64.0 * factors[2].w, 20.0 / 17.0 * third.yz,
                       35.0 / 64.0 * third.x);
    factors[2].x -= 1.875 * third.w;
}

// Integrals over elevations, of one azimuth, of the polynomials times the cosine to a facet's
// normal: b += width of the azimuth times these. `slope`: tangent of the elevation, at least 0,
// above which the sky is seen; `along`: the horizontal direction (x, y); `towards`: its product
// with the normal; `up`: z of the normal.
//
// With s the sine of the elevation and c its cosine, the integrand is y (towards c + up s) ds. The
// integrals of s^n c^m above the horizon follow, for odd m, from
// (n + 2) integral of s^n c = (n - 1) integral of s^(n - 2) c + e^(n - 1) c^3.
void add_polynomials_of_azimuth(float slope, vec2 along, float towards, float up, float width,
                                inout float b[16]) {
    float c = inversesqrt(1.0 + slope * slope), e = min(slope * c, 1.0), e2 = e * e;
    float c2 = c * c, c3 = c * c2;
    float s1 = 0.5 * (1.0 - e2), s2 = (1.0 - e2 * e) / 3.0, s3 = 0.25 * (1.0 - e2 * e2),
          s4 = (1.0 - e2 * e2 * e) / 5.0, s5 = (1.0 - e2 * e2 * e2) / 6.0;
    float s1c = c3 / 3.0, s2c = 0.125 * (atan(c, e) + e * c * (1.0 - 2.0 * e2)),
          s3c = c3 * (1.0 / 3.0 - c2 / 5.0), s4c = (3.0 * s2c + e * e2 * c3) / 6.0;
    float s1c3 = c3 * c2 / 5.0, s2c3 = s2c - s4c;
    float none[4] = float[4](towards * s1c + up * s2, towards * s2c + up * s3,
                             towards * s3c + up * s4, towards * s4c + up * s5);
    float one[3] = float[3](towards * (s1 - s3) + up * s2c, towards * (s2 - s4) + up * s3c,
                            towards * (s3 - s5) + up * s4c);
    float two[2] = float[2](towards * s1c3 + up * (s2 - s4), towards * s2c3 + up * (s3 - s5));
    float three = towards * (s1 - 2.0 * s3 + s5) + up * s2c3;
    float terms[16];
    assemble_polynomials(none, one, two, three, along, terms);
    for (int k = 0; k < 16; ++k)
        b[k] += width * terms[k];
}

#endif
