#version 460
#extension GL_GOOGLE_include_directive : require

// How depth changes across the triangles that a light sees.

#include "shading/shadows/shadow_slope.glsl"

layout(location = 0) out vec2 slope;

void main() {
    slope = shadow_slope();
}
