#ifndef LIB_TRANSFER_LIGHT_GLSL
#define LIB_TRANSFER_LIGHT_GLSL

#include "lib/displacement/transfer_basis.glsl"

// Integrals of light with the polynomials of transfer (lib/displacement/transfer_basis.glsl), from
// its moments over the hemisphere (interface/environment/hemisphere_moments.h): these polynomials,
// too, are the cosine times polynomials of the direction up to degree 3.

// The cubic moments x_i x_j x_k with i = 0, 1, 2.
mat3 cubic_moments(mat4 m, int i) {
    if (i == 0)
        return mat3(m[0].x, m[0].y, m[0].z, m[0].y, m[0].w, m[1].x, m[0].z, m[1].x, m[1].y);
    if (i == 1)
        return mat3(m[0].y, m[0].w, m[1].x, m[0].w, m[1].z, m[1].w, m[1].x, m[1].w, m[2].x);
    return mat3(m[0].z, m[1].x, m[1].y, m[1].x, m[1].w, m[2].x, m[1].y, m[2].x, m[2].y);
}

mat3 quadratic_moments(mat4 m) {
    return mat3(m[2].z, m[2].w, m[3].x, m[2].w, m[3].y, m[3].z, m[3].x, m[3].z, m[3].w);
}

// `moments`: of one colour, about the third row of `tangent_from_light`, whose rows are the axes of
// the polynomials, unit and orthogonal.
void transfer_polynomials_of_light(mat4 moments, mat3 tangent_from_light, out float y[16]) {
    mat3 light_from_tangent = transpose(tangent_from_light);
    mat3 cubic[3];
    for (int i = 0; i < 3; ++i) {
        vec3 axis = light_from_tangent[i];
        cubic[i] = tangent_from_light *
                   (axis.x * cubic_moments(moments, 0) + axis.y * cubic_moments(moments, 1) +
                    axis.z * cubic_moments(moments, 2)) *
                   light_from_tangent;
    }
    mat3 quadratic = tangent_from_light * quadratic_moments(moments) * light_from_tangent;
    // Of a unit vector, the sum of squares is 1.
    float none = quadratic[0][0] + quadratic[1][1] + quadratic[2][2];
    vec3 linear = cubic[0][0] + cubic[1][1] + cubic[2][2];
    float xz = quadratic[0][2], yz = quadratic[1][2], zz = quadratic[2][2];
    float product = quadratic[0][1], difference = quadratic[0][0] - quadratic[1][1];
    float xyz = cubic[0][1][2], difference_z = cubic[0][0][2] - cubic[1][1][2];
    vec3 square_z = cubic[2][2];
    y = float[16](none, linear.x, linear.y, linear.z - 0.75 * none, product,
                  xz - 0.625 * linear.x, yz - 0.625 * linear.y, difference,
                  zz - 4.0 / 3.0 * linear.z + 0.4 * none, cubic[0][0][0] - 3.0 * cubic[0][1][1],
                  3.0 * cubic[0][0][1] - cubic[1][1][1], xyz - 35.0 / 64.0 * product,
                  difference_z - 35.0 / 64.0 * difference,
                  square_z.x - 20.0 / 17.0 * xz + 73.0 / 238.0 * linear.x,
                  square_z.y - 20.0 / 17.0 * yz + 73.0 / 238.0 * linear.y,
                  square_z.z - 1.875 * zz + 15.0 / 14.0 * linear.z - 5.0 / 28.0 * none);
    for (int k = 0; k < 16; ++k)
        y[k] *= TRANSFER_SCALE[k];
}

#endif
