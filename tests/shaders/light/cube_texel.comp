#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/light/cube_texel.glsl"

// a: face, texel, size.
vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    ivec4 texel = ivec4(a);
    return vec4(cube_texel_direction(texel.x, texel.yz, texel.w),
                cube_texel_solid_angle(texel.yz, texel.w));
}
