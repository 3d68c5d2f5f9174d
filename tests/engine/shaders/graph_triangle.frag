#version 460

layout(set = 0, binding = 9) uniform sampler2D unused; // nothing is bound to it

layout(location = 0) in vec4 vertex_colour;

layout(location = 0) out vec4 colour_out;

void main() {
    colour_out = vertex_colour;
}
