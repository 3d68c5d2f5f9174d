#version 460

layout(local_size_x = 64) in;

layout(push_constant) uniform constants_block {
    float offset;
    uint first;
    uint count;
};
layout(set = 0, binding = 0) readonly buffer source_block { float source[]; };
layout(set = 0, binding = 1) writeonly buffer target_block { float target[]; };

void main() {
    uint n = first + gl_GlobalInvocationID.x;
    if (n < first + count)
        target[n] = source[n] + offset;
}
