#version 460
#extension GL_GOOGLE_include_directive : require

// One triangle over the whole picture, at the depth of a batch's number. Shading reads the picture
// of surfaces, so that it needs nothing of what shading.vert gives it.

#include "interface/instance.h"
#include "interface/picture/surfaces.h"

layout(push_constant) uniform draw_block { draw_constants draw; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec4 coordinates;
layout(location = 4) out vec4 colour;
layout(location = 5) out float map_width;
layout(location = 6) flat out float vertex_spacing;

void main() {
    position = normal = vec3(0.0);
    tangent = coordinates = colour = vec4(0.0);
    map_width = vertex_spacing = 0.0;
    gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0,
                       float(draw.number) * SURFACES_DEPTH_OF_NUMBER, 1.0);
}
