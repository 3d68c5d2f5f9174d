#version 460
#extension GL_GOOGLE_include_directive : require

// Draws a mesh flat, at its texture coordinates.

#include "interface/atlas.h"
#include "interface/vertex.h"

layout(set = 0, binding = 1, std430) readonly buffer vertex_block { vertex vertices[]; };
layout(push_constant) uniform atlas_block { atlas_layout atlas; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;

void main() {
    vertex v = vertices[gl_VertexIndex];
    position = vec3(v.position[0], v.position[1], v.position[2]);
    normal = vec3(v.normal[0], v.normal[1], v.normal[2]);
    tangent = vec4(v.tangent[0], v.tangent[1], v.tangent[2], v.tangent[3]);
    vec3 set = atlas.second_coordinates != 0u
                   ? vec3(v.texture_coordinates[2], v.texture_coordinates[3], 1.0)
                   : vec3(v.texture_coordinates[0], v.texture_coordinates[1], 1.0);
    // Row 0 of the map is v = 0, at the top; y points down in clip space.
    vec2 uv = vec2(dot(atlas.u.xyz, set), dot(atlas.v.xyz, set));
    gl_Position = vec4(2.0 * uv - 1.0, 0.5, 1.0);
}
