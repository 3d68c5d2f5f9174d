#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/base_lobe.glsl"
#include "lib/microfacet/directional_albedo.glsl"

// What a table holds: a; F_0 and F_90 of one channel: b.x, b.y. Or a distribution and a roughness:
// a.x, a.y; the cosine: a.z; any parameter: a.w.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0: {
        uint distribution = uint(a.x);
        float parameter = microfacet_parameter(distribution, a.y);
        return vec4(directional_albedo_position(distribution, a.z, parameter),
                    directional_albedo_position(distribution, a.z, a.w));
    }
    default:
        return vec4(specular_albedo(a, b.xxx, b.yyy).y, diffuse_albedo(a, b.zzz, b.xxx, b.yyy).y,
                    multiple_scattering_scale(a, b.xxx).y, 0.0);
    }
}
