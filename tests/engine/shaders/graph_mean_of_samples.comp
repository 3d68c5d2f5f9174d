#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DMS samples;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D mean;

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(position, imageSize(mean))))
        return;
    vec4 sum = vec4(0.0);
    for (int n = 0; n < 4; ++n)
        sum += texelFetch(samples, position, n);
    imageStore(mean, position, 0.25 * sum);
}
