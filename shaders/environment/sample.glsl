#ifndef ENVIRONMENT_SAMPLE_GLSL
#define ENVIRONMENT_SAMPLE_GLSL

// One unbiased sample of the environment's light reflected by a base material, for pictures that
// average many samples: one direction drawn from the environment and one from the material,
// weighted by the balance heuristic (Veach, Guibas, 1995, Optimally Combining Sampling Techniques
// for Monte Carlo Rendering, Eq. 14).
//
// The environment is that of the exact integral: radiance is constant within a texel of level 0.

#include "environment/environment.glsl"
#include "shading/base_sample.glsl"
#include "lib/light/cube_texel.glsl"
#include "lib/light/luminance.glsl"

// ---------------------------------------------------------------------------------------------
// Random numbers

// Jarzynski, Olano, 2020, Hash Functions for GPU Rendering: pcg.
uint scrambled(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Powers of the roots of x^3 = x + 1 and x^4 = x + 1, times 2^32: two and three dimensions
// (Roberts, 2018, The Unreasonable Effectiveness of Quasirandom Sequences).
const uint SEQUENCE_STEPS[5] =
    uint[5](3242174889u, 2447445414u, 3518319155u, 2882110345u, 2360945575u);

// Number `dimension` of this sample, in [0, 1). Each pixel and pattern starts its sequence at a
// different point.
float sample_number(uvec2 pixel, uint dimension) {
    uint seed = scrambled(pixel.x +
                          scrambled(pixel.y +
                                    scrambled(environment.pattern * 8u + dimension)));
    uint number = seed + environment.sample_number * SEQUENCE_STEPS[dimension];
    return float(number >> 8u) / 16777216.0;
}

// ---------------------------------------------------------------------------------------------
// The environment

int last_level() {
    return textureQueryLevels(environment_faces) - 1;
}

vec3 face_texel(int face, ivec2 texel, int level) {
    return texelFetch(environment_faces, ivec3(texel, face), level).rgb;
}

// Luminance over the whole sphere, from the last level: levels hold means.
float total_luminance() {
    float sum = 0.0;
    for (int face = 0; face < 6; ++face)
        sum += lobe_luminance(face_texel(face, ivec2(0), last_level()));
    return sum * (2.0 * PI / 3.0);
}

// Luminance of a texel of a level times its solid angle: the sum over its children.
float texel_luminance(int face, ivec2 texel, int level) {
    int size = textureSize(environment_faces, level).x;
    return lobe_luminance(face_texel(face, texel, level)) * cube_texel_solid_angle(texel, size);
}

// Picks the first of two with the probability of its share, and rescales the random number for
// reuse.
bool takes_first(float first, float second, inout float number) {
    float share = first / max(first + second, 1e-30);
    bool taken = number < share;
    number = taken ? number / share : (number - share) / max(1.0 - share, 1e-30);
    number = clamp(number, 0.0, 0.99999994);
    return taken;
}

// Clarberg, Jarosz, Akenine-Moller, Jensen, 2005, Wavelet Importance Sampling: descends the levels,
// each time to one of four texels in proportion to their luminance. The probability density is the
// texel's luminance divided by that of the sphere.
vec3 direction_from_environment(vec2 numbers) {
    int face = 0;
    float left = numbers.x * total_luminance();
    for (int i = 0; i < 5; ++i) {
        float sent = lobe_luminance(face_texel(face, ivec2(0), last_level())) * (2.0 * PI / 3.0);
        if (face == i && left >= sent) {
            left -= sent;
            face = i + 1;
        }
    }
    numbers.x = clamp(left / max(texel_luminance(face, ivec2(0), last_level()), 1e-30), 0.0,
                      0.99999994);
    ivec2 texel = ivec2(0);
    for (int level = last_level() - 1; level >= 0; --level) {
        texel *= 2;
        float a = texel_luminance(face, texel, level);
        float b = texel_luminance(face, texel + ivec2(1, 0), level);
        float c = texel_luminance(face, texel + ivec2(0, 1), level);
        float d = texel_luminance(face, texel + ivec2(1, 1), level);
        bool left_half = takes_first(a + c, b + d, numbers.x);
        texel.x += left_half ? 0 : 1;
        bool upper_half = takes_first(left_half ? a : b, left_half ? c : d, numbers.y);
        texel.y += upper_half ? 0 : 1;
    }
    int size = textureSize(environment_faces, 0).x;
    vec2 place = (vec2(texel) + numbers) * (2.0 / float(size)) - 1.0;
    return normalize(cube_direction(face, place));
}

// Radiance of the texel that a direction of the environment's space lies in.
vec3 texel_radiance(vec3 direction) {
    return textureLod(environment_texels, direction, 0.0).rgb;
}

// ---------------------------------------------------------------------------------------------
// Both

vec3 weighted_sample(surface_point surface, base_material base, vec3 incoming, float total) {
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 radiance = texel_radiance(to_environment(surface, incoming));
    float density = material_density(base, surface.outgoing, incoming) +
                    lobe_luminance(radiance) / max(total, 1e-30);
    vec3 reflectance = evaluate_base_material(base, surface.outgoing, incoming);
    return density > 0.0 ? reflectance * radiance * (environment.intensity / density) : vec3(0.0);
}

vec3 sampled_environment(surface_point surface, base_material base) {
    float total = total_luminance();
    vec3 from_environment = direction_from_environment(
        vec2(sample_number(surface.pixel, 0u), sample_number(surface.pixel, 1u)));
    vec3 world = environment.environment_from_world[0].xyz * from_environment.x +
                 environment.environment_from_world[1].xyz * from_environment.y +
                 environment.environment_from_world[2].xyz * from_environment.z;
    vec3 sum = weighted_sample(surface, base, world * surface.world_from_tangent, total);
    vec3 numbers = vec3(sample_number(surface.pixel, 2u), sample_number(surface.pixel, 3u),
                        sample_number(surface.pixel, 4u));
    vec3 from_material = direction_from_material(base, surface.outgoing, numbers);
    return sum + weighted_sample(surface, base, from_material, total);
}

#endif
