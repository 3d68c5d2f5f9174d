#version 460
#extension GL_GOOGLE_include_directive : require

// A coarse level of a map of mixtures, from the sums for its texels' components over parts of them.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray part_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray moment_map;

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID), size = imageSize(moment_map);
    if (any(greaterThanEqual(position, size)))
        return;
    ivec2 parts = textureSize(part_map, 0).xy;
    ivec2 low = position.xy * parts / size.xy;
    ivec2 high = ((position.xy + 1) * parts + size.xy - 1) / size.xy;
    vec4 sum = vec4(0.0);
    for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) {
            ivec2 begin = max(ivec2(x, y) * size.xy, position.xy * parts);
            ivec2 end = min(ivec2(x + 1, y + 1) * size.xy, (position.xy + 1) * parts);
            vec2 weight = vec2(end - begin) / vec2(parts);
            sum += weight.x * weight.y * texelFetch(part_map, ivec3(x, y, position.z), 0);
        }
    }
    imageStore(moment_map, position, sum);
}
