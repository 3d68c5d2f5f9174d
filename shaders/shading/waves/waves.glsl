#ifndef WAVES_GLSL
#define WAVES_GLSL

// Shading of a surface with waves, which lie on the plane of the tangent frame. Before it includes
// this file, a filter includes what fetches its maps; after it, it defines
//
//   footprint_waves wave_slopes(surface_point, out float level)
//                                        of the maps alone; MIP level
//   base_material wave_material(surface_point)
//   vec3 wave_emission(surface_point)
//   float wave_height()                  factor of all slopes
//
// The waves are drawn on a plane: nothing hides anything, and a pixel sees as much of the plane
// wherever waves face it. So that no energy is lost or made at any distance, facets are masked and
// foreshortened not by the slopes of their own pixel, but as all waves together would be: only the
// distribution of normals is the pixel's. It is linear: the mean over samples of the maps and the
// shading of the mean distribution are the same, if that is Gaussian.

#include "interface/waves.h"
#include "lib/map/displaced_slope.glsl"
#include "lib/microfacet/slope_masking.glsl"
#include "shading/base_material.glsl"
#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif

layout(constant_id = SPECIALISE_WAVE_LAYERS) const uint WAVE_LAYERS = 1;
layout(constant_id = SPECIALISE_WAVES_CHOPPY) const bool WAVES_CHOPPY = true;

layout(LOBE_DESCRIPTOR(33)) uniform sampler2DArray wave_fields;
layout(LOBE_DESCRIPTOR(34), std140) uniform wave_block { wave_constants waves; };

// Steps of the search for what has moved to a point: each leaves about a third of the error where
// waves are steep.
const int WAVE_STEPS = 3;

// Texture coordinates run downwards, bitangents upwards.
vec2 wave_point(vec2 coordinates) {
    return vec2(coordinates.x, -coordinates.y);
}

vec4 wave_field(vec2 point, uint layer, uint field) {
    return textureLod(wave_fields,
                      vec3(point * waves.frequency[layer], OCEAN_FIELDS * layer + field), 0.0);
}

struct appearance {
    base_material base;
    slope_distribution slopes; // base lobes included
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// Slopes of a footprint; the covariance is (xx, yy, xy).
struct footprint_waves {
    vec2 mean;
    vec3 covariance;
};

footprint_waves wave_slopes(surface_point surface, out float level);
base_material wave_material(surface_point surface);
vec3 wave_emission(surface_point surface);
float wave_height();

vec3 base_slope_covariance(base_material base) {
    return vec3(vec2(1.0 / base_lobe_concentration(DISTRIBUTION, base.width)), 0.0);
}

// Of all waves and base lobes.
slope_distribution all_slopes(base_material base) {
    float height = wave_height();
    return slope_distribution_of(vec2(0.0),
                                 height * height * waves.total.xyz + base_slope_covariance(base));
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    result.base = wave_material(surface);
    footprint_waves slopes = wave_slopes(surface, result.level);
    float height = wave_height();
    result.slopes = slope_distribution_of(
        height * slopes.mean, height * height * (slopes.covariance + waves.rest.xyz) +
                                  base_slope_covariance(result.base) + surface.curvature);
    result.normal = normal_of_slope(result.slopes.mean);
    result.base.normal = vec3(0.0, 0.0, 1.0);
    result.emission = EMISSION ? wave_emission(surface) : vec3(0.0);
    result.kept = true;
    result.lobe_count = 1.0;
    return result;
}

#include "shading/lights/no_gathering.glsl"

// Dupuy et al. 2013, Eq. 17, with the masking and the foreshortening of all waves.
vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    vec3 outgoing = surface.outgoing;
    if (incoming.z <= 0.0 || outgoing.z <= 0.0)
        return vec3(0.0);
    vec3 halfway = half_vector(incoming, outgoing);
    vec3 fresnel = fresnel_schlick(fetched.base.specular, vec3(1.0), dot(incoming, halfway));
    float visible = masking_shadowing_of_slopes(all_slopes(fetched.base), incoming, outgoing);
    vec3 sum = microfacet_specular(fresnel, distribution_of_slopes(fetched.slopes, halfway),
                                   visible, outgoing.z);
    if (DIFFUSE)
        sum += microfacet_diffuse(fetched.base.diffuse, fresnel, incoming.z);
    return sum;
}

#ifdef ENVIRONMENT
// What facets of a slope reflect of a unit radiance, times the slope's share of the plane.
vec3 reflected_by_slope(slope_distribution all, vec2 slope, vec3 f0, vec3 outgoing) {
    vec3 normal = normal_of_slope(slope);
    float cosine = dot(normal, outgoing);
    vec3 incoming = 2.0 * cosine * normal - outgoing;
    float visible = masking_shadowing_of_slopes(all, incoming, outgoing);
    return max(height_above_slope(slope, outgoing), 0.0) * visible *
           fresnel_schlick(f0, vec3(1.0), cosine);
}

// Dupuy et al. 2013, Algorithm 1: the reflected radiance of a grid of slopes. Each sample reads the
// mean over as far as neighbours are apart, which adds spacing^2/4 to the samples' variance (see
// grid_spacing). Nothing adds it to what the facets reflect, which is taken at slopes further
// apart.
vec3 reflect_waves(appearance fetched, surface_point surface) {
    slope_distribution all = all_slopes(fetched.base), slopes = fetched.slopes;
    vec3 outgoing = surface.outgoing;
    float spacing = grid_spacing();
    float wider = inversesqrt(max(1.0 - 0.25 * spacing * spacing, 0.1));
    float area = spacing * spacing * slopes.root.x * slopes.root.y;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint j = 0u; j < ENVIRONMENT_GRID; ++j) {
        for (uint k = 0u; k < ENVIRONMENT_GRID; ++k) {
            vec2 place = spacing * (vec2(j, k) - 0.5 * (float(ENVIRONMENT_GRID) - 1.0));
            vec3 normal = normal_of_slope(slope_at(slopes, place));
            vec3 incoming = 2.0 * dot(normal, outgoing) * normal - outgoing;
            float weight = exp(-0.5 * dot(place, place));
            float solid_angle = area * normal.z * normal.z * normal.z;
            vec3 reflected = reflected_by_slope(all, slope_at(slopes, wider * place),
                                                fetched.base.specular, outgoing);
            sum += weight * reflected *
                   sample_radiance(surface, half_vector_sample(normal, weight, solid_angle),
                                   incoming);
            weights += weight;
        }
    }
    return sum / (weights * max(outgoing.z, COSINE_MINIMUM));
}

vec3 reflect_environment(appearance fetched, surface_point surface) {
    if (surface.outgoing.z <= 0.0)
        return vec3(0.0);
    vec3 sum = reflect_waves(fetched, surface);
    if (DIFFUSE)
        sum += reflect_lambert(surface, fetched.base, SURFACE_NORMAL);
    return sum;
}
#endif

#endif
