#ifndef LIB_SLOPE_STRETCH_GLSL
#define LIB_SLOPE_STRETCH_GLSL

#include "lib/number/finite.glsl"

// A triangle whose slope over the tangent plane is larger counts as one of this slope: it is seen
// under an interpolated normal that is almost perpendicular to its own.
const float STEEPEST_TRIANGLE = 20.0;

// Slopes of a relief over a surface on which its map is stretched and sheared, from slopes over a
// map with square texels that is `width` metres wide and keeps its shape: Dupuy, Heitz, Iehl,
// Poulin, Neyret, Ostromoukhov 2013, Linear Efficient Antialiased Displacement and Reflectance
// Mapping, Eq. 12, s = J^-T grad h, J = d(x, y)/d(u, v), by the chain rule through the pixel. y of
// the map's slopes is along -v. `aspect`: rows of the map over its columns.
//
// `dx`, `dy`: change of position to the next pixel, along the tangent, the bitangent and the
// normal; `uv_dx`, `uv_dy`: that of the texture coordinates; `outgoing`: towards the viewer. Where
// positions are those of a relief that is drawn, they hold its height h and the curvature K of
// what it lies on, too: (I + h K) J takes the place of J.
mat2 slope_stretch(vec3 dx, vec3 dy, vec2 uv_dx, vec2 uv_dy, vec3 outgoing, float width,
                   float aspect) {
    vec3 sizes = max(abs(dx), abs(dy));
    float size = max(max(max(sizes.x, sizes.y), sizes.z), 1e-37);
    dx /= size, dy /= size; // products are in range at any scale
    vec3 normal = cross(dx, dy);
    float side = dot(normal, outgoing) < 0.0 ? -1.0 : 1.0;
    float area = side * max(max(side * normal.z, length(normal) / STEEPEST_TRIANGLE), 1e-30);
    float factor = width / size / area;
    vec2 along_x = factor * vec2(dy.y, -dy.x), along_y = factor * vec2(-dx.y, dx.x);
    mat2 stretch = mat2(uv_dx.x * along_x + uv_dy.x * along_y,
                        -aspect * (uv_dx.y * along_x + uv_dy.y * along_y));
    float largest = dot(abs(stretch[0]) + abs(stretch[1]), vec2(1.0));
    return is_finite(largest) ? stretch : mat2(0.0);
}

// Covariance (xx, yy, xy) of the slopes A s.
vec3 stretched_covariance(mat2 a, vec3 covariance) {
    mat2 c = a * mat2(covariance.x, covariance.z, covariance.z, covariance.y) * transpose(a);
    return vec3(c[0][0], c[1][1], c[0][1]);
}

#endif
