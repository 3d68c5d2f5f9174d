#version 460

layout(push_constant) uniform Push {
    vec4 offset;
};

layout(set = 0, binding = 0, std430) readonly buffer Vertices {
    vec4 vertices[];
};

void main() {
    gl_Position = vertices[gl_VertexIndex] + offset;
}
