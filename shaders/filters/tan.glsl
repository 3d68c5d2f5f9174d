// A mixture of round Gaussians of normals, projected onto the surface: Tan, Lin, Quan, Guo, Shum
// 2005, Multiresolution Reflectance Filtering. Their Cook-Torrance term has neither masking nor the
// factors that make a density of projected normals one of half vectors per solid angle and solid
// angles of half vectors those of light; the two factors, cos(theta_h) and 1/4, are added here.
//
// The paper has no light from all around. Here each Gaussian reflects it as a lobe of half vectors,
// masked like the base material.

#include "shading/level_0.glsl"
#include "shading/mask.glsl"
#include "interface/gaussian_mixture.h"
#include "interface/moment_bins.h"

#ifdef ENVIRONMENT
#include "environment/reflection.glsl"
#endif

layout(constant_id = SPECIALISE_BINS) const uint BINS = 4;
layout(constant_id = SPECIALISE_MIXTURE_PRINTED) const bool PRINTED = false;

layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray moment_map;

struct projected_lobe {
    float part;
    vec2 mean;
    float variance; // along each axis
    vec3 normal;
};

struct appearance {
    base_material base;     // level 0, where it may be seen
    base_material filtered; // averaged over the footprint
    projected_lobe lobes[MOMENT_MAXIMUM_BINS];
    float base_share; // [0, 1]: how much of the appearance is level 0
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// Printed: the variance is the difference of |n|^2's mean and |m|^2, although |n|^2 has those of
// both axes.
projected_lobe read_lobe(surface_point surface, map_area area, uint index) {
    vec4 sums = filtered_layer(moment_map, area, index);
    projected_lobe lobe;
    lobe.part = sums.x;
    vec2 mean = sums.yz / max(sums.x, 1e-6);
    float square = sums.w / max(sums.x, 1e-6) - dot(mean, mean);
    lobe.variance =
        max(PRINTED ? square : 0.5 * square, 1e-6) + isotropic_variance(surface.curvature);
    lobe.mean = mean * min(1.0, 0.999 * inversesqrt(max(dot(mean, mean), 1e-12)));
    lobe.normal = vec3(lobe.mean, sqrt(1.0 - dot(lobe.mean, lobe.mean)));
    return lobe;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    map_area area = lobe_area(surface);
    bool near = may_see_level_0(lobe_map());
    result.base_share = !FILTERED_LOBES ? 1.0 : near ? clamp(1.0 - area.level, 0.0, 1.0) : 0.0;
    result.level = FILTERED_LOBES ? area.level : 0.0;
    result.lobe_count = result.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    result.normal = unfiltered_normal(surface);
    vec3 mean = vec3(0.0);
    for (uint i = 0u; FILTERED_LOBES && i < BINS; ++i) {
        result.lobes[i] = read_lobe(surface, area, i);
        mean += result.lobes[i].part * result.lobes[i].normal;
        result.lobe_count += result.lobes[i].part > 0.0 ? 1.0 : 0.0;
    }
    if (FILTERED_LOBES)
        result.normal = mean_direction(mean, vec3(0.0, 0.0, 1.0));
    result.filtered = filtered_material(surface, result.normal, area);
    result.base = result.filtered;
    if (FILTERED_LOBES && near)
        result.base = level_0_material(surface, normals_of_level_0(surface, area.level, 1.0));
    result.kept = !ALPHA_MASK || keeps_footprint(surface);
    result.emission = EMISSION ? filtered_emission(surface, area) : vec3(0.0);
    return result;
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

float density_of(projected_lobe lobe, vec2 place) {
    vec2 d = place - lobe.mean;
    return lobe.part * exp(-0.5 * dot(d, d) / lobe.variance) / (2.0 * PI * lobe.variance);
}

// Without a divisor for half-vector lobes; otherwise over 4 <m, omega_o> for each Gaussian.
float sum_lobes(appearance fetched, vec3 halfway, vec3 outgoing) {
    float sum = 0.0;
    for (uint i = 0u; i < BINS; ++i) {
        float density = density_of(fetched.lobes[i], halfway.xy) * halfway.z;
        float cosine = dot(fetched.lobes[i].normal, outgoing);
        if (MODEL == MODEL_HALF_VECTOR_LOBES)
            sum += density;
        else if (cosine > 0.0)
            sum += density / (4.0 * max(cosine, COSINE_MINIMUM));
    }
    return sum;
}

float mean_cosine(appearance fetched, vec3 incoming) {
    float sum = 0.0;
    for (uint i = 0u; i < BINS; ++i)
        sum += fetched.lobes[i].part * max(dot(fetched.lobes[i].normal, incoming), 0.0);
    return sum;
}

vec3 colour_of_all_lobes() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        sum += material.lobe_colour[i].rgb;
    return sum;
}

vec3 evaluate_mixture(appearance fetched, vec3 outgoing, vec3 incoming) {
    vec3 halfway = half_vector(incoming, outgoing);
    float specular = sum_lobes(fetched, halfway, outgoing);
    vec3 fresnel = vec3(0.0), colour = fetched.filtered.specular * colour_of_all_lobes();
    if (MODEL == MODEL_MICROFACET)
        colour = fresnel =
            fresnel_schlick(fetched.filtered.specular, vec3(1.0), dot(incoming, halfway));
    vec3 sum = colour * specular;
    if (DIFFUSE)
        sum += microfacet_diffuse(fetched.filtered.diffuse, fresnel,
                                  mean_cosine(fetched, incoming));
    return sum;
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 sum = vec3(0.0);
    if (FILTERED_LOBES)
        sum = (1.0 - fetched.base_share) * evaluate_mixture(fetched, surface.outgoing, incoming);
    if (!FILTERED_LOBES || may_see_level_0(lobe_map()))
        sum += fetched.base_share *
               evaluate_base_material(fetched.base, surface.outgoing, incoming);
    return sum;
}

#ifdef ENVIRONMENT
vec3 reflect_lobe(appearance fetched, surface_point surface, projected_lobe lobe) {
    float deviation = sqrt(lobe.variance);
    vec2 down = -lobe.mean / max(lobe.normal.z, 0.2);
    half_vector_distribution half_vectors = half_vector_distribution(
        direction_lobe(lobe.normal, deviation * vec3(1.0, 0.0, down.x),
                       deviation * vec3(0.0, 1.0, down.y)),
        DISTRIBUTION_VMF);
    if (MODEL == MODEL_MICROFACET)
        return reflect_microfacets(surface, half_vectors, fetched.filtered.specular,
                                   fetched.filtered.width);
    return colour_of_all_lobes() * fetched.filtered.specular *
           reflect_half_vectors(surface, half_vectors);
}

vec3 reflect_environment(inout appearance fetched, surface_point surface) {
    if (!FILTERED_LOBES)
        return reflect_base_material(surface, fetched.filtered, fetched.filtered.normal);
    vec3 sum = vec3(0.0), mean = vec3(0.0);
    for (uint i = 0u; i < BINS; ++i) {
        projected_lobe lobe = fetched.lobes[i];
        if (lobe.part < 1.0 / 64.0)
            continue;
        sum += lobe.part * reflect_lobe(fetched, surface, lobe);
        mean += lobe.part * lobe.normal;
    }
    if (DIFFUSE)
        sum += reflect_lambert(surface, fetched.filtered, mean);
    sum *= 1.0 - fetched.base_share;
    if (may_see_level_0(lobe_map()))
        sum += fetched.base_share *
               reflect_base_material(surface, fetched.base, fetched.base.normal);
    return sum;
}
#endif
