#version 460

layout(local_size_x = 1) in;
layout(set = 1, binding = 0) buffer Elsewhere {
    float value;
};

void main() {
    value = 1;
}
