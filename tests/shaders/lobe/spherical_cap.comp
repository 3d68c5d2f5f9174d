#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/cube_texel.glsl"
#include "lib/lobe/spherical_cap.glsl"

// a: direction of the axis, angle; b: face, size, row.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    int face = int(b.x), size = int(b.y);
    vec3 axis = cube_face_coordinates(face, a.xyz);
    spherical_cap cap = spherical_cap(axis, sin(a.w), cos(a.w));
    float y = (2.0 * b.z + 1.0) / b.y - 1.0;
    return vec4(texels_between(cap_rows(cap), size), texels_between(cap_columns(cap, y), size));
}
