#version 460

// A host's simulation: normals of ripples that run over a map, which is tilted all around. Also
// colours that go with them.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, rgba8) uniform writeonly image2D normals;

layout(push_constant) uniform ripple_block {
    float phase;
    float waves;
    float depth; // 0: flat
} ripples;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(normals);
    if (any(greaterThanEqual(texel, size)))
        return;
    vec2 place = 6.2831853 * (vec2(texel) + 0.5) / vec2(size);
    vec2 slope = 0.4 * vec2(cos(ripples.phase), sin(ripples.phase)) +
                 0.5 * vec2(cos(ripples.waves * place.x + ripples.phase),
                            cos(2.0 * place.x + ripples.waves * place.y - ripples.phase));
    vec3 normal = normalize(vec3(-ripples.depth * slope, 1.0));
    imageStore(normals, texel, vec4(0.5 + 0.5 * normal, 1.0));
}
