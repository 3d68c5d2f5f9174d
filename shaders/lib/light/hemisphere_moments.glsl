#ifndef LIB_HEMISPHERE_MOMENTS_GLSL
#define LIB_HEMISPHERE_MOMENTS_GLSL

#include "interface/environment/hemisphere_moments.h"
#include "lib/light/octahedron.glsl"

// Integrals of an environment's light with polynomials of the direction over the hemisphere of a
// normal, weighted by its cosine (passes/environment/hemisphere_moments.h). Directions are in the
// environment's space.

// All moments of one hemisphere: for each colour, the numbers in the order of
// interface/environment/hemisphere_moments.h, four a column.
struct hemisphere_moments {
    mat4 red, green, blue;
};

mat4 moments_of_colour(sampler2DArray map, vec2 coordinates, float first) {
    return mat4(textureLod(map, vec3(coordinates, first), 0.0),
                textureLod(map, vec3(coordinates, first + 1.0), 0.0),
                textureLod(map, vec3(coordinates, first + 2.0), 0.0),
                textureLod(map, vec3(coordinates, first + 3.0), 0.0));
}

// The sampler is linear and clamped. `normal`: unit.
hemisphere_moments hemisphere_moments_about(sampler2DArray map, vec3 normal) {
    vec2 coordinates = octahedron_coordinates(normal, float(HEMISPHERE_MOMENTS_SIZE));
    return hemisphere_moments(moments_of_colour(map, coordinates, 0.0),
                              moments_of_colour(map, coordinates, 4.0),
                              moments_of_colour(map, coordinates, 8.0));
}

// The coefficients of <a, w> (w^T A w), for a symmetric A, in the moments' order.
mat4 cubic_form(vec3 a, mat3 A) {
    return mat4(a.x * A[0].x, a.y * A[0].x + 2.0 * a.x * A[0].y,   // xxx, xxy
                a.z * A[0].x + 2.0 * a.x * A[0].z,                 // xxz
                a.x * A[1].y + 2.0 * a.y * A[0].y,                 // xyy
                2.0 * (a.x * A[1].z + a.y * A[0].z + a.z * A[0].y), // xyz
                a.x * A[2].z + 2.0 * a.z * A[0].z, a.y * A[1].y,   // xzz, yyy
                a.z * A[1].y + 2.0 * a.y * A[1].z,                 // yyz
                a.y * A[2].z + 2.0 * a.z * A[1].z, a.z * A[2].z,   // yzz, zzz
                vec2(0.0), vec4(0.0));
}

// The coefficients of w^T A w, for a symmetric A.
mat4 quadratic_form(mat3 A) {
    return mat4(vec4(0.0), vec4(0.0), 0.0, 0.0, A[0].x, 2.0 * A[0].y, 2.0 * A[0].z, A[1].y,
                2.0 * A[1].z, A[2].z);
}

float contracted(mat4 a, mat4 b) {
    return dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2]) + dot(a[3], b[3]);
}

// The integral of <n, w> L(w) p(w), p given by its coefficients.
vec3 gathered_light(hemisphere_moments moments, mat4 polynomial) {
    return vec3(contracted(moments.red, polynomial), contracted(moments.green, polynomial),
                contracted(moments.blue, polynomial));
}

#endif
