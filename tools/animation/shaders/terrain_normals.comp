#version 460
#extension GL_GOOGLE_include_directive : require

// Normals of a height map that repeats, x and y of unit vectors with y upwards.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D heights;
layout(set = 0, binding = 1, rg16f) writeonly uniform image2D texels;

layout(push_constant) uniform constants_block {
    float factor; // height 1, in widths of a texel
};

float height_at(ivec2 texel, ivec2 size) {
    return texelFetch(heights, (texel + size) % size, 0).r;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(texels);
    if (any(greaterThanEqual(texel, size)))
        return;
    float across = height_at(texel + ivec2(1, 0), size) - height_at(texel - ivec2(1, 0), size);
    float down = height_at(texel + ivec2(0, 1), size) - height_at(texel - ivec2(0, 1), size);
    vec3 normal = normalize(vec3(-0.5 * factor * across, 0.5 * factor * down, 1.0));
    imageStore(texels, texel, vec4(normal.xy, 0.0, 0.0));
}
