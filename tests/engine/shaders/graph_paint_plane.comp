#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, r32f) uniform writeonly image2D target;

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(position, imageSize(target))))
        imageStore(target, position, vec4(1.0));
}
