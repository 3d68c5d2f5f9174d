#ifndef LIB_HEMISPHERE_MOMENTS_GLSL
#define LIB_HEMISPHERE_MOMENTS_GLSL

#include "interface/environment/hemisphere_moments.h"
#include "lib/number/constants.glsl"
#include "lib/light/octahedron.glsl"

// Integrals of an environment's light with polynomials of the direction over the hemisphere of a
// normal, weighted by its cosine (passes/environment/hemispheres/hemisphere_moments.h). Directions
// are in the environment's space.

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

// Of radiance 1 from everywhere:
//   2 pi/15 (delta_ij n_k + delta_jk n_i + delta_ki n_j),  pi/4 (delta_ij + n_i n_j)
mat4 moments_of_uniform_light(vec3 normal) {
    vec3 cubic = 2.0 * PI / 15.0 * normal, n = normal;
    vec4 first = vec4(3.0 * cubic.x, cubic.y, cubic.z, cubic.x);
    vec4 second = vec4(0.0, cubic.x, 3.0 * cubic.y, cubic.z);
    float quarter = 0.25 * PI;
    return mat4(first, second, cubic.y, 3.0 * cubic.z, quarter * (1.0 + n.x * n.x),
                quarter * n.x * n.y, quarter * n.x * n.z, quarter * (1.0 + n.y * n.y),
                quarter * n.y * n.z, quarter * (1.0 + n.z * n.z));
}

// The sampler is linear and clamped. `normal`: unit.
hemisphere_moments hemisphere_moments_about(sampler2DArray map, vec3 normal) {
    vec2 coordinates = octahedron_coordinates(normal, float(HEMISPHERE_MOMENTS_SIZE));
    vec3 mean = textureLod(map, vec3(coordinates, float(HEMISPHERE_MOMENT_LAYERS - 1)), 0.0).rgb;
    mat4 uniform_light = moments_of_uniform_light(normal);
    return hemisphere_moments(moments_of_colour(map, coordinates, 0.0) + mean.r * uniform_light,
                              moments_of_colour(map, coordinates, 4.0) + mean.g * uniform_light,
                              moments_of_colour(map, coordinates, 8.0) + mean.b * uniform_light);
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
