#version 460
#extension GL_GOOGLE_include_directive : require

// Heights of a land that repeats, in [0, 1]: octaves of gradient noise (Perlin 2002, Improving
// Noise), of which each is half as high and half as wide as the one before, and lower where the
// land is steep already, as if its rubble had been washed away. The three widest octaves, which
// make mountains, end at the valley in the middle.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, r32f) writeonly uniform image2D texels;

const int OCTAVES = 10;
const int MOUNTAINS = 3;      // octaves
const uint FIRST_CELLS = 4u;  // to the map's width, of the widest octave
const float FLOOR = 0.2;      // of the valley
const float AMPLITUDE = 0.42; // of the widest octave
const float EROSION = 2.2;

// Jarzynski, Olano 2020, Hash Functions for GPU Rendering: PCG in two dimensions.
vec2 random_gradient(uvec2 corner, uint cells, uint octave) {
    uvec2 v = corner % cells + 7919u * octave;
    v = v * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return vec2(v) * (2.0 / 4294967296.0) - 1.0;
}

// The noise and its derivatives along x and y, in cells.
vec3 gradient_noise(vec2 place, uint cells, uint octave) {
    uvec2 corner = uvec2(place);
    vec2 f = fract(place);
    vec2 share = f * f * f * (f * (6.0 * f - 15.0) + 10.0);
    vec2 growth = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    vec2 g00 = random_gradient(corner, cells, octave);
    vec2 g10 = random_gradient(corner + uvec2(1u, 0u), cells, octave);
    vec2 g01 = random_gradient(corner + uvec2(0u, 1u), cells, octave);
    vec2 g11 = random_gradient(corner + uvec2(1u, 1u), cells, octave);
    vec4 planes = vec4(dot(g00, f), dot(g10, f - vec2(1.0, 0.0)), dot(g01, f - vec2(0.0, 1.0)),
                       dot(g11, f - vec2(1.0, 1.0)));
    vec2 top = mix(planes.xz, planes.yw, share.x);
    vec2 along = mix(mix(g00, g10, share.x), mix(g01, g11, share.x), share.y);
    along.x += growth.x * mix(planes.y - planes.x, planes.w - planes.z, share.y);
    along.y += growth.y * (top.y - top.x);
    return vec3(mix(top.x, top.y, share.y), along);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(texels);
    if (any(greaterThanEqual(texel, size)))
        return;
    vec2 place = (vec2(texel) + 0.5) / vec2(size);
    float away = smoothstep(0.02, 0.3, length(place - 0.5));
    float height = 0.0, amplitude = AMPLITUDE;
    vec2 slope = vec2(0.0);
    for (int i = 0; i < OCTAVES; ++i) {
        uint cells = FIRST_CELLS << i;
        float part = i < MOUNTAINS ? away : 0.3 + 0.7 * away;
        vec3 noise = part * gradient_noise(float(cells) * place, cells, uint(i));
        slope += noise.yz;
        height += amplitude * (noise.x + (i < MOUNTAINS ? 0.3 * part : 0.0)) /
                  (1.0 + EROSION * dot(slope, slope));
        amplitude *= 0.5;
    }
    imageStore(texels, texel, vec4(clamp(FLOOR + height, 0.0, 1.0)));
}
