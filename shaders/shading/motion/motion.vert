#version 460
#extension GL_GOOGLE_include_directive : require

// Where a mesh's vertices are, as in shading.vert, and where they were in the previous frame.

#include "interface/instance.h"
#include "interface/motion.h"
#include "interface/vertex.h"

layout(set = 0, binding = 0, std140) uniform motion_block { motion_constants motion; };
layout(set = 0, binding = 1, std430) readonly buffer vertex_block { vertex vertices[]; };
layout(set = 0, binding = 2, std430) readonly buffer previous_vertex_block {
    vertex previous_vertices[];
};
layout(set = 0, binding = 3, std430) readonly buffer instance_block {
    instance_constants instances[];
};
layout(set = 0, binding = 4, std430) readonly buffer previous_instance_block {
    instance_constants previous_instances[];
};
layout(push_constant) uniform draw_block { draw_constants draw; };

invariant gl_Position; // the depths of shading.vert
layout(location = 0) out vec3 current;
layout(location = 1) out vec3 change;

instance_constants instance;

#include "shading/instance_transform.glsl"

void main() {
    vertex v = vertices[gl_VertexIndex];
    instance = instances[draw.first_instance + gl_InstanceIndex];
    vec3 position = vec3(v.position[0], v.position[1], v.position[2]);
    vec3 world_position = transform_point(position);
    gl_Position = motion.world_to_clip * vec4(world_position, 1.0);
    current = (motion.current * vec4(world_position, 1.0)).xyw;

    // Again, as precise as before: their difference is 0 where nothing moved, to the bit. The first
    // has the rounding of shading.vert.
    precise vec3 now = transform_point(position);
    v = previous_vertices[gl_VertexIndex];
    instance = previous_instances[draw.first_instance + gl_InstanceIndex];
    precise vec3 before = transform_point(vec3(v.position[0], v.position[1], v.position[2]));
    change = (motion.change * vec4(before, 1.0)).xyw +
             (motion.current * vec4(before - now, 0.0)).xyw;
}
