#version 460

layout(local_size_x = 64) in;

layout(push_constant) uniform constants_block {
    float factor;
    uint count;
};
layout(set = 0, binding = 0) writeonly buffer target_block { float target[]; };

void main() {
    uint n = gl_GlobalInvocationID.x;
    if (n < count)
        target[n] = factor * float(n);
}
