#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/displacement/transfer_light.glsl"

// The moments of a single light over the hemisphere of a normal.
mat4 moments_of(vec3 d, vec3 normal) {
    mat4 monomials = mat4(d.x * d.x * d, d.x * d.y * d.y, d.x * d.y * d.z, d.x * d.z * d.z,
                          d.y * d.y * d.yz, d.y * d.z * d.z, d.z * d.z * d.z, d.x * d.xy, d.x * d.z,
                          d.y * d.yz, d.z * d.z);
    return max(dot(normal, d), 0.0) * monomials;
}

// Rows: the axes of a tangent frame with this normal, mirrored if c.w is negative.
mat3 frame_of(vec3 normal, vec4 c) {
    vec3 first = normalize(cross(normal, c.xyz));
    return transpose(mat3(first, c.w * cross(normal, first), normal));
}

// Functions 0 to 3: four polynomials each of the direction a; 4 to 7: their integrals over an
// azimuth: a: slope, along, towards; b.x: up; b.y: width. 8 to 11: of the light from a in the frame
// of b and c, by its moments; 12 to 15: by its direction. 16 to 19: of the direction a, over its
// height, by products of its coordinates.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    float y[16];
    if (FUNCTION < 4u) {
        transfer_polynomials(a.xyz, y);
    } else if (FUNCTION >= 16u) {
        vec4 terms[4];
        transfer_terms(a.xyz, terms);
        for (uint k = 0u; k < 16u; ++k) {
            vec4 factors[4] = vec4[4](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
            factors[k / 4u][k % 4u] = 1.0;
            transfer_products(factors);
            y[k] = 0.0;
            for (uint i = 0u; i < 4u; ++i)
                y[k] += dot(factors[i], terms[i]);
        }
    } else if (FUNCTION >= 12u) {
        transfer_polynomials(frame_of(b.xyz, c) * a.xyz, y);
    } else if (FUNCTION >= 8u) {
        transfer_polynomials_of_light(moments_of(a.xyz, b.xyz), frame_of(b.xyz, c), y);
    } else {
        for (int k = 0; k < 16; ++k)
            y[k] = 0.0;
        add_polynomials_of_azimuth(a.x, a.yz, a.w, b.x, b.y, y);
    }
    uint first = 4u * (FUNCTION % 4u);
    return vec4(y[first], y[first + 1u], y[first + 2u], y[first + 3u]);
}
