#version 460
#extension GL_GOOGLE_include_directive : require

// Rain on a normal map: rings that spread from drops, on top of the map's own slopes. A function of
// time alone: any frame can be drawn without those before it.

#include "lib/number/constants.glsl"
#include "slope_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Jarzynski, Olano 2020, Hash Functions for GPU Rendering: PCG in three dimensions.
uvec3 hashed(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

vec3 numbers(uvec3 v) {
    return vec3(hashed(v)) * (1.0 / 4294967296.0);
}

// The slope of a ring's wave train at a distance from where the drop fell; `radius` and `distance`
// in cells. Waves are ten to a cell and die out as the ring spreads.
float ring(float distance, float radius, float age) {
    float behind = (distance - radius) / 0.09;
    float height = (1.0 - age) * (1.0 - age) * smoothstep(0.0, 0.1, age);
    return height * exp(-behind * behind) * sin(20.0 * PI * (distance - radius));
}

// Drops fall into the cells of a grid, one at a time into each, at times and places of its own. A
// ring ends before it reaches its cell's border.
vec2 drops(vec2 place, float cells, float period, uint layer) {
    vec2 cell = floor(place * cells);
    float phase = numbers(uvec3(cell, layer)).x + time / period;
    vec3 random = numbers(uvec3(cell, layer + 2u * uint(int(floor(phase)) + 1)));
    vec2 offset = place * cells - cell - (0.4 + 0.2 * random.xy);
    float distance = length(offset), age = fract(phase);
    float slope = (0.15 + 0.25 * random.z) * ring(distance, 0.36 * age, age);
    return slope * smoothstep(0.4, 0.3, distance) * offset / max(distance, 1e-4);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(texels);
    if (any(greaterThanEqual(texel, size)))
        return;
    vec2 place = (vec2(texel) + 0.5) / vec2(size);
    vec2 slope = slope_of_texel(texelFetch(base, texel, 0).rgb);
    slope += drops(place, 9.0, 1.3, 0u) + drops(fract(place + 0.37), 14.0, 0.9, 1u);
    imageStore(texels, texel, texel_of_slope(slope));
}
