#version 460

// One level from the one above it, exact for even sizes; both in one image.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 0, binding = 1) uniform writeonly image2DArray target;

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(position, imageSize(target))))
        return;
    vec4 sum = vec4(0.0);
    for (int n = 0; n < 4; ++n)
        sum += texelFetch(source, ivec3(2 * position.xy + ivec2(n & 1, n >> 1), position.z), 0);
    imageStore(target, position, 0.25 * sum);
}
