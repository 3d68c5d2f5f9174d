#version 460
#extension GL_GOOGLE_include_directive : require

#include "shading/samples/sample_mask.glsl"

void main() {
    gl_FragDepth = hidden_depth();
}
