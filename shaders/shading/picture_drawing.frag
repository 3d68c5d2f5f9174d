#version 460

// Draws a picture uploaded from host memory, rows from the top.

layout(push_constant) uniform constants_block { uint width; };
layout(set = 0, binding = 0, std430) readonly buffer picture_block { vec4 picture[]; };

layout(location = 0) out vec4 radiance_out;

void main() {
    uvec2 position = uvec2(gl_FragCoord.xy);
    radiance_out = picture[position.y * width + position.x];
}
