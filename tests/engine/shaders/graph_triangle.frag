#version 460

layout(location = 0) in vec4 vertex_colour;

layout(location = 0) out vec4 colour_out;

void main() {
    colour_out = vertex_colour;
}
