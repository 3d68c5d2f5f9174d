#version 460
#extension GL_GOOGLE_include_directive : require

// The light that von Mises-Fisher lobes about many directions receive from an environment, by one
// of the methods that are fast enough for rendering.

#include "check.h"
#include "lib/number/constants.glsl"
#include "lib/light/environment_level.glsl"
#include "lib/lobe/von_mises_fisher.glsl"
#include "shading/tangent_frame.glsl"

layout(local_size_x = CHECK_GROUP_SIZE) in;

layout(constant_id = CHECK_METHOD) const uint method = METHOD_PREFILTERED;

layout(set = 0, binding = 0) uniform samplerCube radiance;
layout(set = 0, binding = 1) uniform samplerCube filtered;
// METHOD_BLENDED: levels of lobes twice as concentrated.
layout(set = 0, binding = 2) uniform samplerCube between;
layout(set = 0, binding = 3, std430) readonly buffer directions_block { vec4 directions[]; };
layout(set = 0, binding = 4, std430) writeonly buffer lights_block { vec4 lights[]; };

layout(push_constant) uniform constants_block { environment_check_constants constants; };

// Hammersley, 1960: point i of n, well spread over the unit square; the second coordinate is the
// radical inverse of i (van der Corput).
vec2 hammersley(uint i, uint n) {
    return vec2((float(i) + 0.5) / float(n), float(bitfieldReverse(i)) * (1.0 / 4294967296.0));
}

// Jakob, 2012, Numerically stable sampling of the von Mises-Fisher distribution on S^2, Eq. 1: the
// cosine of the angle to the mean is 1 + log(u + (1 - u) exp(-2 kappa))/kappa.
vec3 von_mises_fisher_sample(vec2 point, float kappa) {
    float u = 1.0 - point.x;
    float complement = -log(u + (1.0 - u) * exp(-2.0 * kappa)) / kappa;
    float sine = sqrt(max(complement * (2.0 - complement), 0.0));
    float angle = 2.0 * PI * point.y;
    return vec3(sine * cos(angle), sine * sin(angle), 1.0 - complement);
}

// Krivanek, Colbert, 2008, Real-time Shading with Filtered Importance Sampling: samples distributed
// as the lobe, each read from the level whose texels cover the solid angle that it represents, 1/(N
// p). Without the paper's additional factor K = 4, which trades noise for blur: it doubles the
// error of lobes from kappa = 64 on, and helps only at 1.
vec3 sampled_light(vec3 direction) {
    mat3 frame = tangent_frame(direction, vec4(0.0));
    float width = float(textureSize(radiance, 0).x);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < constants.samples; ++i) {
        vec3 offset =
            von_mises_fisher_sample(hammersley(i, constants.samples), constants.concentration);
        float density = von_mises_fisher(offset, vec3(0.0, 0.0, 1.0), constants.concentration);
        float level = solid_angle_level(width, 1.0 / (float(constants.samples) * density));
        sum += textureLod(radiance, frame * offset, level).rgb;
    }
    return sum / float(constants.samples);
}

// McGuire et al., 2013, Plausible Blinn-Phong Reflection of Standard Cube MIP-Maps, Eq. 5: the
// level whose texels cover what the lobe does, here the inverse of its peak instead of
// 2 pi/(s + 1).
vec3 mip_light(vec3 direction) {
    float solid_angle = 1.0 / von_mises_fisher_peak(constants.concentration);
    float width = float(textureSize(radiance, 0).x);
    return textureLod(radiance, direction, solid_angle_level(width, solid_angle)).rgb;
}

// Lobes more concentrated than those of the finest level are blended with the unfiltered radiance.
vec3 with_radiance(vec3 light, vec3 direction, float finest) {
    float size = float(textureSize(radiance, 0).x);
    float share = radiance_share(finest, size, constants.concentration);
    return share > 0.0 ? mix(light, textureLod(radiance, direction, 0.0).rgb, share) : light;
}

vec3 prefiltered_light(vec3 direction) {
    float width = float(textureSize(filtered, 0).x);
    float level = prefiltered_level(width, constants.concentration);
    return with_radiance(textureLod(filtered, direction, level).rgb, direction,
                         prefiltered_concentration(width, 0.0));
}

vec3 blended_light(vec3 direction) {
    float width = float(textureSize(filtered, 0).x);
    prefiltered_blend levels = blend_of_lobe(width, constants.concentration);
    vec3 light = mix(textureLod(between, direction, levels.level_between).rgb,
                     textureLod(filtered, direction, levels.level).rgb, levels.share);
    return with_radiance(light, direction, 2.0 * prefiltered_concentration(width, 0.0));
}

vec3 light(vec3 direction) {
    if (method == METHOD_SAMPLED)
        return sampled_light(direction);
    if (method == METHOD_MIP)
        return mip_light(direction);
    return method == METHOD_BLENDED ? blended_light(direction) : prefiltered_light(direction);
}

void main() {
    uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * constants.count;
    if (gl_GlobalInvocationID.x < constants.count)
        lights[index] = vec4(light(directions[gl_GlobalInvocationID.x].xyz), 0.0);
}
