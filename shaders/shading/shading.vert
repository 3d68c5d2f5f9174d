#version 460
#extension GL_GOOGLE_include_directive : require

// Transforms a mesh's vertices to clip space.

#include "interface/frame.h"
#include "interface/instance.h"
#include "interface/specialisation.h"
#include "interface/vertex.h"

layout(set = 0, binding = 0, std140) uniform frame_block { frame_constants frame; };
layout(set = 0, binding = 1, std430) readonly buffer vertex_block { vertex vertices[]; };
layout(set = 0, binding = 12, std430) readonly buffer instance_block {
    instance_constants instances[];
};
layout(push_constant) uniform draw_block { draw_constants draw; };

layout(location = 0) out vec3 world_position;
layout(location = 1) out vec3 world_normal;
layout(location = 2) out vec4 world_tangent;
layout(location = 3) out vec4 coordinates;
layout(location = 4) out vec4 colour;
layout(location = 5) out float map_width; // of the height map, metres; 0 unless STRETCHED

layout(location = 6) flat out float vertex_spacing; // pixels; 0 unless DISPLACED

layout(constant_id = SPECIALISE_STRETCHED) const bool STRETCHED = false;
layout(constant_id = SPECIALISE_DISPLACED) const bool DISPLACED = false;

invariant gl_Position; // motion/motion.vert computes the same depths

instance_constants instance;

#include "shading/instance_transform.glsl"

void main() {
    vertex v = vertices[gl_VertexIndex];
    instance = instances[draw.first_instance + gl_InstanceIndex];
    world_position = transform_point(vec3(v.position[0], v.position[1], v.position[2]));
    world_normal = transform_normal(vec3(v.normal[0], v.normal[1], v.normal[2]));
    world_tangent = transform_tangent(vec4(v.tangent[0], v.tangent[1], v.tangent[2], v.tangent[3]));
    coordinates = vec4(v.texture_coordinates[0], v.texture_coordinates[1],
                       v.texture_coordinates[2], v.texture_coordinates[3]);
    colour = vec4(v.colour[0], v.colour[1], v.colour[2], v.colour[3]);
    map_width = STRETCHED ? draw.map_width * thickness(vec3(v.normal[0], v.normal[1], v.normal[2]))
                          : 0.0;
    vertex_spacing = DISPLACED ? frame.vertex_spacing * vertices[0].position[0] : 0.0;
    gl_Position = frame.world_to_clip * vec4(world_position, 1.0);
}
