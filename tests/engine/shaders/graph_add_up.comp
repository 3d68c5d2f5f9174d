#version 460

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer source_block { float source[]; };
layout(set = 0, binding = 1) buffer sum_block { float sum[]; };

void main() {
    uint n = gl_GlobalInvocationID.x;
    if (n < sum.length())
        sum[n] += source[n];
}
