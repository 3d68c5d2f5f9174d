#version 460

// Two outputs; the second is the pixel's position.

layout(location = 0) in vec4 vertex_colour;

layout(location = 0) out vec4 colour_out;
layout(location = 2) out vec2 position_out;

void main() {
    colour_out = vertex_colour;
    position_out = gl_FragCoord.xy;
}
