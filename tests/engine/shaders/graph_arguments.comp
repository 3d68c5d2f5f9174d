#version 460

// Writes five words at each of two places.

layout(local_size_x = 1) in;

layout(push_constant) uniform constants_block {
    uvec4 first;
    uvec4 second;
    uint offset; // words, of the second
};
layout(set = 0, binding = 0) writeonly buffer argument_block { uint arguments[]; };

void write(uint place, uvec4 words) {
    arguments[place] = words.x;
    arguments[place + 1] = words.y;
    arguments[place + 2] = words.z;
    arguments[place + 3] = words.w;
    arguments[place + 4] = 0u;
}

void main() {
    write(0u, first);
    write(offset, second);
}
