#version 460

// Writes x + 100 * y + 10000 * layer.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform writeonly image2DArray target;

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    if (all(lessThan(position, imageSize(target))))
        imageStore(target, position, vec4(dot(vec3(position), vec3(1.0, 100.0, 10000.0))));
}
