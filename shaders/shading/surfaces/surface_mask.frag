#version 460
#extension GL_GOOGLE_include_directive : require

// In a picture of surfaces, hides the pixels that another sample leaves alone. What was drawn
// before hides the background.

#include "interface/picture/surfaces.h"
#include "shading/samples/sample_mask.glsl"

layout(location = SURFACES_POSITION) out vec4 position_out;

void main() {
    gl_FragDepth = hidden_depth();
    position_out = vec4(0.0, 0.0, 0.0, gl_FragDepth > 0.0 ? SURFACES_HIDDEN : 0.0);
}
