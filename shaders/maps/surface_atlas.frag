#version 460
#extension GL_GOOGLE_include_directive : require

// The surface frame at each texel of a mesh's atlas, in object space.

#include "shading/tangent_frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;

layout(location = 0) out vec4 atlas_normal;   // xyz: unit; w: 1, covered
layout(location = 1) out vec4 atlas_tangent;  // xyz: unit; w: handedness
layout(location = 2) out vec4 atlas_position; // xyz

void main() {
    mat3 frame = tangent_frame(normal, tangent);
    atlas_normal = vec4(frame[2], 1.0);
    atlas_tangent = vec4(frame[0], tangent.w < 0.0 ? -1.0 : 1.0);
    atlas_position = vec4(position, 1.0);
}
