#version 460

// Adds one sample of the picture to the sum of samples, in float32.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(set = 0, binding = 1, rgba32f) uniform image2D sum;

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(position, imageSize(sum))))
        return;
    imageStore(sum, position, imageLoad(sum, position) + texelFetch(radiance, position, 0));
}
