#ifndef ENVIRONMENT_REFLECTED_LOBES_GLSL
#define ENVIRONMENT_REFLECTED_LOBES_GLSL

// What microfacets of middling roughness reflect of the environment, as a sum of round lobes
// (interface/environment/reflected_lobes.h).

#include "environment/lobes.glsl"
#include "interface/environment/reflected_lobes.h"
#include "lib/microfacet/fresnel.glsl"

layout(LOBE_DESCRIPTOR(43)) uniform sampler2DArray reflected_lobes_table;
#ifdef SLOPE_FILTER
// Of microfacets that the filter has turned into Gaussian slopes.
layout(LOBE_DESCRIPTOR(44)) uniform sampler2DArray slope_reflected_lobes_table;
#endif

vec4 reflected_lobe_row(uint kind, vec2 place, int i) {
#ifdef SLOPE_FILTER
    if (kind == DISTRIBUTION_BECKMANN)
        return textureLod(slope_reflected_lobes_table, vec3(place, float(i)), 0.0);
#endif
    return textureLod(reflected_lobes_table, vec3(place, float(i)), 0.0);
}

// What is left of a round lobe above the surface, whose own normal's horizon has already cut it:
// `direction` moves up if the lobe is clipped.
float lobe_share_above_surface(vec3 normal, float concentration, inout vec3 direction) {
    float narrow = sqrt(concentration);
    float own = max(narrow * dot(direction, normal), -3.0);
    float height = max(narrow * direction.z, -3.0);
    float share_before = max(normal_below(own), 0.05), share = normal_below(height);
    if (HORIZON == HORIZON_CLIPPED) {
        float shift =
            normal_density(height) / max(share, 1e-3) - normal_density(own) / share_before;
        direction = normalize(direction + (max(shift, 0.0) / narrow) * SURFACE_NORMAL);
    }
    return CLOSED ? 1.0 : min(share / share_before, 1.0);
}

// For unit reflectance: the light over what it is in white surroundings. `variance_of_normals`: per
// axis. `cut`: by the horizon of the mapped surface. `share`: of this light that is asked for; 0
// costs nothing even where other pixels ask for some.
vec3 light_of_reflected_lobes(surface_point surface, vec3 normal, uint kind, vec3 f0,
                              float roughness, float variance_of_normals, bool cut, float share) {
    const float size = float(REFLECTED_LOBES_SIZE);
    float cosine = clamp(dot(normal, surface.outgoing), 0.0, 1.0);
    float row = (roughness - REFLECTED_LOBES_LEAST_ROUGHNESS) /
                (REFLECTED_LOBES_GREATEST_ROUGHNESS - REFLECTED_LOBES_LEAST_ROUGHNESS);
    vec2 place = (clamp(vec2(sqrt(cosine), row), 0.0, 1.0) * (size - 1.0) + 0.5) / size;
    vec3 forward = -perpendicular_towards(normal, surface.outgoing);
    vec3 beside = cross(normal, forward);
    float mirror_angle = acos(cosine);
    // Normals turn directions by up to 2 in the plane of reflection and 2 cosine across it.
    float turned = 2.0 * (1.0 + cosine * cosine) * variance_of_normals;
    float finest = log2(float(textureSize(prefiltered_environment, 0).x));
    vec3 light = vec3(0.0), weights = vec3(0.0);
    int count = share > 0.0 ? 2 * REFLECTED_LOBES - REFLECTED_LOBES_IN_PLANE : 0;
    for (int i = 0; i < count; ++i) {
        int pair = (i - REFLECTED_LOBES_IN_PLANE) / 2;
        bool single = i < REFLECTED_LOBES_IN_PLANE;
        vec4 lobe = reflected_lobe_row(kind, place, single ? i : REFLECTED_LOBES_IN_PLANE + pair);
        float angle = mirror_angle + lobe.x;
        vec3 direction = sqrt((1.0 - lobe.y) * (1.0 + lobe.y)) *
                             (cos(angle) * normal + sin(angle) * forward) +
                         ((i & 1) == 0 ? lobe.y : -lobe.y) * beside;
        // Of a level of t texels the variance is 16/t^2.
        float texels = exp2(lobe.z), concentration = texels * texels / 16.0;
        float broader = 1.0 + turned * concentration;
        float half_cosine = sqrt(max(0.5 + 0.5 * dot(direction, surface.outgoing), 0.0));
        vec3 part = (single ? lobe.w : 0.5 * lobe.w) *
                    fresnel_schlick(f0, vec3(1.0), half_cosine);
        weights += part;
        if (cut)
            part *= lobe_share_above_surface(normal, concentration / broader, direction);
        light += part * textureLod(prefiltered_environment, to_environment(surface, direction),
                                   finest - lobe.z + 0.5 * log2(broader)).rgb;
    }
    return environment.intensity * share * light / max(weights, 1e-6);
}

#endif
