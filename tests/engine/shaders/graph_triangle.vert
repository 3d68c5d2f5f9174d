#version 460

layout(push_constant) uniform constants_block {
    vec4 colour;
    float depth;
};
layout(set = 0, binding = 0) readonly buffer vertex_block { vec2 vertices[]; };

layout(location = 0) out vec4 vertex_colour;

void main() {
    vertex_colour = colour;
    gl_Position = vec4(vertices[gl_VertexIndex], depth, 1.0);
}
