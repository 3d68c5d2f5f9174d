#version 460
#extension GL_GOOGLE_include_directive : require

// Brings the vertices of a lobe_mesh to the world and, in perspective, to clip space.

#include "own_shading.glsl"

layout(push_constant) uniform draw_block { mat4 world_from_object; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 coordinates;
layout(location = 4) in vec4 colour;

layout(location = 0) out vec3 world_position;
layout(location = 1) out vec3 world_normal;
layout(location = 2) out vec4 world_tangent;
layout(location = 3) out vec4 both_coordinates;
layout(location = 4) out vec4 tint;

// A perspective with reversed depth: 1 at the near plane, 0 at infinity.
mat4 world_to_clip() {
    vec3 eye = vector(camera.eye);
    vec3 forward = normalize(vector(camera.target) - eye);
    vec3 right = normalize(cross(forward, vector(camera.up)));
    vec3 up = cross(right, forward);
    return transpose(mat4(scales[0] * vec4(right, -dot(right, eye)),
                          -scales[1] * vec4(up, -dot(up, eye)),
                          vec4(0.0, 0.0, 0.0, camera.near_plane),
                          vec4(forward, -dot(forward, eye))));
}

void main() {
    mat3 linear = mat3(world_from_object);
    world_position = vec3(world_from_object * vec4(position, 1.0));
    world_normal = normalize(transpose(inverse(linear)) * normal);
    world_tangent = vec4(linear * tangent.xyz, tangent.w);
    both_coordinates = coordinates;
    tint = colour;
    gl_Position = world_to_clip() * vec4(world_position, 1.0);
}
