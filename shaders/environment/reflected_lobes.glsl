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

// Towards one viewer, about one normal.
struct reflecting_surface {
    vec3 normal, forward, beside; // of the tangent frame; forward: away from the viewer
    float mirror_angle;           // from the normal, radians
    float variance_of_normals;    // of the directions that they turn a lobe to, per axis
    bool cut;                     // by the horizon of the mapped surface
};

// What is left of a round lobe above the surface, whose own normal's horizon has already cut it:
// `direction` moves up if the lobe is clipped.
float lobe_share_above_surface(reflecting_surface reflecting, float concentration,
                               inout vec3 direction) {
    float narrow = sqrt(concentration);
    float own = max(narrow * dot(direction, reflecting.normal), -3.0);
    float height = max(narrow * direction.z, -3.0);
    float share_before = max(normal_below(own), 0.05), share = normal_below(height);
    if (HORIZON == HORIZON_CLIPPED) {
        float shift =
            normal_density(height) / max(share, 1e-3) - normal_density(own) / share_before;
        direction = normalize(direction + (max(shift, 0.0) / narrow) * SURFACE_NORMAL);
    }
    return CLOSED ? 1.0 : min(share / share_before, 1.0);
}

struct reflected_sum {
    vec3 light, weight;
};

void add_reflected_lobe(inout reflected_sum sum, surface_point surface,
                        reflecting_surface reflecting, vec3 direction, float concentration,
                        float weight, vec3 f0) {
    float half_cosine = sqrt(max(0.5 + 0.5 * dot(direction, surface.outgoing), 0.0));
    vec3 part = weight * fresnel_schlick(f0, vec3(1.0), half_cosine);
    sum.weight += part;
    if (reflecting.cut)
        part *= lobe_share_above_surface(reflecting, concentration, direction);
    sum.light += part * round_radiance(surface, DISTRIBUTION_VMF, direction, concentration);
}

// For unit reflectance: the light over what it is in white surroundings.
vec3 light_of_reflected_lobes(surface_point surface, vec3 normal, uint kind, vec3 f0,
                              float roughness, float variance_of_normals, bool cut) {
    const float size = float(REFLECTED_LOBES_SIZE);
    float cosine = clamp(dot(normal, surface.outgoing), 0.0, 1.0);
    float row = (roughness - REFLECTED_LOBES_LEAST_ROUGHNESS) /
                (REFLECTED_LOBES_GREATEST_ROUGHNESS - REFLECTED_LOBES_LEAST_ROUGHNESS);
    vec2 place = (clamp(vec2(sqrt(cosine), row), 0.0, 1.0) * (size - 1.0) + 0.5) / size;
    vec3 forward = -perpendicular_towards(normal, surface.outgoing);
    // Normals turn directions by up to 2 in the plane of reflection and 2 cosine across it.
    float turned = 2.0 * (1.0 + cosine * cosine) * variance_of_normals;
    reflecting_surface reflecting =
        reflecting_surface(normal, forward, cross(normal, forward), acos(cosine), turned, cut);
    reflected_sum sum = reflected_sum(vec3(0.0), vec3(0.0));
    for (int i = 0; i < REFLECTED_LOBES; ++i) {
        vec4 lobe = reflected_lobe_row(kind, place, i);
        float angle = reflecting.mirror_angle + lobe.x;
        float concentration = 1.0 / (exp(-lobe.z) + reflecting.variance_of_normals);
        vec3 in_plane = sqrt((1.0 - lobe.y) * (1.0 + lobe.y)) *
                        (cos(angle) * normal + sin(angle) * forward);
        bool single = i < REFLECTED_LOBES_IN_PLANE;
        float weight = single ? lobe.w : 0.5 * lobe.w;
        add_reflected_lobe(sum, surface, reflecting, in_plane + lobe.y * reflecting.beside,
                           concentration, weight, f0);
        if (!single)
            add_reflected_lobe(sum, surface, reflecting, in_plane - lobe.y * reflecting.beside,
                               concentration, weight, f0);
    }
    return environment.intensity * sum.light / max(sum.weight, 1e-6);
}

#endif
