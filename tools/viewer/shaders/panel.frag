#version 460
#extension GL_GOOGLE_include_directive : require

// The panels' colours are already encoded for the window; alpha is straight.

#include "panel.h"

layout(push_constant) uniform panel_block { panel_constants panel; };
layout(set = 0, binding = 1) uniform sampler2D font;

layout(location = 0) in vec2 texture_coordinates;
layout(location = 1) in vec4 colour;
layout(location = 0) out vec4 colour_out;

void main() {
    float alpha = colour.a * textureLod(font, texture_coordinates, 0.0).r;
    if (any(lessThan(gl_FragCoord.xy, panel.clip.xy)) ||
        any(greaterThan(gl_FragCoord.xy, panel.clip.zw)))
        discard;
    colour_out = vec4(colour.rgb * alpha, alpha);
}
