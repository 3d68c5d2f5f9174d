#version 460

// Writes an index-dependent value; group size and value are specialisation constants.

layout(local_size_x_id = 0, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 1) const float factor = 1;

layout(push_constant) uniform Push {
    uint count;
};

layout(set = 0, binding = 0) writeonly buffer Target {
    float target[];
};

void main() {
    if (gl_GlobalInvocationID.x < count)
        target[gl_GlobalInvocationID.x] = factor * float(gl_GlobalInvocationID.x);
}
