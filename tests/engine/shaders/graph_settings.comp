#version 460

// Reads a uniform block of 32 bytes, and writes nothing.

layout(local_size_x = 1) in;

layout(set = 0, binding = 0, std140) uniform settings_block {
    vec4 first;
    vec4 second;
};

shared vec4 sum;

void main() {
    sum = first + second;
}
