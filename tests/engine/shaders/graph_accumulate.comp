#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D sample_image;
layout(set = 0, binding = 1, r32f) uniform image2D sum;

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(position, imageSize(sum))))
        imageStore(sum, position,
                   imageLoad(sum, position) + texelFetch(sample_image, position, 0));
}
