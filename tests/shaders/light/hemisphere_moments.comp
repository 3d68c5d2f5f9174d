#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/hemisphere_moments.glsl"

// The moments' monomials at a direction.
mat4 monomials(vec3 d) {
    return mat4(d.x * d.x * d.x, d.x * d.x * d.y, d.x * d.x * d.z, d.x * d.y * d.y,
                d.x * d.y * d.z, d.x * d.z * d.z, d.y * d.y * d.y, d.y * d.y * d.z,
                d.y * d.z * d.z, d.z * d.z * d.z, d.x * d.x, d.x * d.y,
                d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z);
}

// a.xyz: a direction; a.w: a factor; b.xyz: a vector; c.xyz: another one.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(octahedron_direction(octahedron_place(a.xyz)), 0.0);
    default: {
        mat3 form = a.w * mat3(1.0) + outerProduct(c.xyz, c.xyz);
        return vec4(contracted(monomials(a.xyz), cubic_form(b.xyz, form)),
                    contracted(monomials(a.xyz), quadratic_form(form)), 0.0, 0.0);
    }
    }
}
