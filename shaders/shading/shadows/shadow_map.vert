#version 460
#extension GL_GOOGLE_include_directive : require

// Where a light sees a mesh's vertices, and what masks need of them.

#include "interface/instance.h"
#include "interface/shadow.h"
#include "interface/vertex.h"

layout(set = 0, binding = 0, std140) uniform view_block { shadow_view view; };
layout(set = 0, binding = 1, std430) readonly buffer vertex_block { vertex vertices[]; };
layout(set = 0, binding = 12, std430) readonly buffer instance_block {
    instance_constants instances[];
};
layout(push_constant) uniform draw_block { draw_constants draw; };

layout(location = 0) out vec4 coordinates;
layout(location = 1) out vec4 colour;

instance_constants instance;

#include "shading/instance_transform.glsl"

void main() {
    vertex v = vertices[gl_VertexIndex];
    instance = instances[draw.first_instance + gl_InstanceIndex];
    coordinates = vec4(v.texture_coordinates[0], v.texture_coordinates[1],
                       v.texture_coordinates[2], v.texture_coordinates[3]);
    colour = vec4(v.colour[0], v.colour[1], v.colour[2], v.colour[3]);
    vec3 position = transform_point(vec3(v.position[0], v.position[1], v.position[2]));
    gl_Position = view.world_to_clip * vec4(position, 1.0);
}
