#version 460

// Binding 0 is a buffer in triangle.vert.
layout(set = 0, binding = 0) uniform sampler2D colours;
layout(location = 0) out vec4 colour;

void main() {
    colour = texture(colours, vec2(0));
}
