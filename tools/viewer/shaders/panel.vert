#version 460
#extension GL_GOOGLE_include_directive : require

// Triangles of the panels. Vertices are imgui_vertex: position, texture coordinates, colour.

#include "panel.h"

layout(push_constant) uniform panel_block { panel_constants panel; };
layout(set = 0, binding = 0, std430) readonly buffer vertices_block { uint vertices[]; };

layout(location = 0) out vec2 texture_coordinates;
layout(location = 1) out vec4 colour;

void main() {
    uint first = 5u * uint(gl_VertexIndex);
    vec2 position = vec2(uintBitsToFloat(vertices[first]), uintBitsToFloat(vertices[first + 1u]));
    texture_coordinates =
        vec2(uintBitsToFloat(vertices[first + 2u]), uintBitsToFloat(vertices[first + 3u]));
    colour = unpackUnorm4x8(vertices[first + 4u]);
    gl_Position = vec4(position * vec2(panel.pixel_width, panel.pixel_height) - 1.0, 0.0, 1.0);
}
