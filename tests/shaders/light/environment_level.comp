#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/environment_level.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    switch (FUNCTION) {
    case 0:
        return vec4(mip_level(a.x, a.y), solid_angle_level(a.x, a.y), 0.0, 0.0);
    case 1:
        return vec4(sharper_share(a.x, a.y, a.z), 0.0, 0.0, 0.0);
    case 2: {
        prefiltered_blend blend = blend_of_lobe(a.x, a.y);
        return vec4(blend.level, blend.level_between, blend.share, 0.0);
    }
    default:
        return vec4(prefiltered_level(a.x, a.y), prefiltered_concentration(a.x, a.z),
                    radiance_share(prefiltered_concentration(a.x, 0.0), a.w, a.y), 0.0);
    }
}
