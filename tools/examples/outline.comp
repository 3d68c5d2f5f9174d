#version 460

// Draws outlines: darkens pixels whose depth differs strongly from their neighbours'.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D radiance;
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D outlined;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = imageSize(outlined) - 1;
    if (any(greaterThan(pixel, last)))
        return;
    // Reversed depth: near plane / distance, and 0 where nothing is hit.
    float here = texelFetch(depth, pixel, 0).r;
    float right = texelFetch(depth, min(pixel + ivec2(1, 0), last), 0).r;
    float below = texelFetch(depth, min(pixel + ivec2(0, 1), last), 0).r;
    float step = max(abs(right - here), abs(below - here));
    bool edge = step > 0.1 * max(here, max(right, below));
    vec4 colour = texelFetch(radiance, pixel, 0);
    imageStore(outlined, pixel, edge ? vec4(0.0, 0.0, 0.0, 1.0) : colour);
}
