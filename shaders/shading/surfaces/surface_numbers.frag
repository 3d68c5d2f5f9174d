#version 460
#extension GL_GOOGLE_include_directive : require

// Turns the numbers of batches into depths, so that shading one of them passes over the others'
// pixels.

#include "interface/picture/surfaces.h"

layout(set = 0, binding = 0) uniform sampler2DArray surfaces;

void main() {
    float whose = texelFetch(surfaces, ivec3(gl_FragCoord.xy, SURFACES_POSITION), 0).w;
    gl_FragDepth = whose < 0.0 ? 1.0 : floor(0.25 * whose) * SURFACES_DEPTH_OF_NUMBER;
}
