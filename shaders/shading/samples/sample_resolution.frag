#version 460
#extension GL_GOOGLE_include_directive : require

// Draws the mean of each pixel's samples.

#include "interface/specialisation.h"

layout(constant_id = SPECIALISE_VIEW) const uint VIEW = VIEW_RADIANCE;

layout(set = 0, binding = 0) uniform sampler2D counts;
layout(set = 0, binding = 1) uniform sampler2D sum;

layout(location = 0) out vec4 radiance_out;

void main() {
    ivec2 position = ivec2(gl_FragCoord.xy);
    float count = texelFetch(counts, position, 0).r;
    vec4 texel = texelFetch(sum, position, 0);
    // The only sample's alpha is its depth.
    if (count == 1.0)
        texel.a = texel.a > 0.0 ? 1.0 : 0.0;
    radiance_out = VIEW == VIEW_SAMPLES ? vec4(vec3(count), 1.0) : texel / count;
}
