// A mixture of round Gaussians of normals, projected onto the surface: Tan, Lin, Quan, Guo, Shum
// 2005, Multiresolution Reflectance Filtering. Their Cook-Torrance term has neither masking nor the
// factors that make a density of projected normals one of half vectors per solid angle and solid
// angles of half vectors those of light; the two factors, cos(theta_h) and 1/4, are added here.

#include "shading/level_0.glsl"
#include "shading/mask.glsl"
#include "filters/mixture/projected.glsl"

layout(constant_id = SPECIALISE_MIXTURE_PRINTED) const bool PRINTED = false;

struct gaussian_lobe {
    float part;
    vec3 normal;
    float variance; // along each axis
};

struct appearance {
    base_material base;     // level 0, where it may be seen
    base_material filtered; // averaged over the footprint
    gaussian_lobe lobes[MOMENT_MAXIMUM_BINS];
    float base_share; // [0, 1]: how much of the appearance is level 0
    vec3 emission;
    bool kept;
    vec3 normal;
    float lobe_count;
    float level;
};

// Printed: the variance is the difference of |n|^2's mean and |m|^2, although |n|^2 has those of
// both axes.
gaussian_lobe read_lobe(surface_point surface, map_area area, uint index) {
    projected_lobe lobe = lobe_of_sums(filtered_layer(moment_map, area, index));
    float variance = max((PRINTED ? lobe.square : 0.5 * lobe.square) +
                             projected_variance_lacking(), 1e-6);
    return gaussian_lobe(lobe.part, lobe.normal,
                         variance + isotropic_variance(surface.curvature));
}

// Returns the sum of normals by their parts. Under a mask, these add up to the share that it keeps.
vec3 take_lobes(inout appearance fetched, surface_point surface, map_area area) {
    float share = 0.0;
    vec3 mean = vec3(0.0);
    for (uint i = 0u; i < BINS; ++i) {
        fetched.lobes[i] = read_lobe(surface, area, i);
        share += fetched.lobes[i].part;
        mean += fetched.lobes[i].part * fetched.lobes[i].normal;
        fetched.lobe_count += fetched.lobes[i].part > 0.0 ? 1.0 : 0.0;
    }
    for (uint i = 0u; i < BINS; ++i)
        fetched.lobes[i].part *= per_kept(share);
    return mean;
}

appearance fetch_appearance(surface_point surface) {
    appearance result;
    map_area area = lobe_area(surface);
    draw_widths(surface);
    bool near = may_see_level_0(lobe_map());
    level_0_normals normals = normals_of_level_0(surface, area, 1.0);
    result.base_share = FILTERED_LOBES ? share_of_level_0(normals, area.share, 1.0) : 1.0;
    result.level = FILTERED_LOBES ? area.level : 0.0;
    result.lobe_count = result.base_share > 0.0 ? float(LOBE_COUNT) : 0.0;
    result.normal = unfiltered_normal(surface);
    if (FILTERED_LOBES)
        result.normal = mean_direction(take_lobes(result, surface, area), vec3(0.0, 0.0, 1.0));
    result.filtered = filtered_material(surface, result.normal, area);
    result.base = result.filtered;
    if (FILTERED_LOBES && near)
        result.base = level_0_material(surface, normals);
    result.kept = !ALPHA_MASK || keeps_footprint(surface);
    result.emission = EMISSION ? filtered_emission(surface, area) : vec3(0.0);
    return result;
}

#include "shading/lights/no_gathering.glsl"

float density_of(gaussian_lobe lobe, vec2 place) {
    vec2 d = place - lobe.normal.xy;
    return lobe.part * exp(-0.5 * dot(d, d) / lobe.variance) / (2.0 * PI * lobe.variance);
}

float sum_lobes(appearance fetched, vec3 halfway, vec3 outgoing) {
    float sum = 0.0;
    for (uint i = 0u; i < BINS; ++i)
        sum += reflected_density(fetched.lobes[i].normal,
                                 density_of(fetched.lobes[i], halfway.xy) * halfway.z, outgoing);
    return sum;
}

float mean_cosine(appearance fetched, vec3 incoming) {
    float sum = 0.0;
    for (uint i = 0u; i < BINS; ++i)
        sum += fetched.lobes[i].part * max(dot(fetched.lobes[i].normal, incoming), 0.0);
    return sum;
}

vec3 evaluate_mixture(appearance fetched, vec3 outgoing, vec3 incoming) {
    vec3 halfway = half_vector(incoming, outgoing);
    return evaluate_projected(fetched.filtered, sum_lobes(fetched, halfway, outgoing),
                              mean_cosine(fetched, incoming), halfway, incoming);
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
direction_lobe shape_of(gaussian_lobe lobe) {
    float deviation = sqrt(lobe.variance);
    vec2 down = -lobe.normal.xy / max(lobe.normal.z, 0.2);
    return direction_lobe(lobe.normal, deviation * vec3(1.0, 0.0, down.x),
                          deviation * vec3(0.0, 1.0, down.y));
}

vec3 reflect_environment(inout appearance fetched, surface_point surface) {
    if (!FILTERED_LOBES)
        return reflect_base_material(surface, fetched.filtered, fetched.filtered.normal);
    vec3 sum = vec3(0.0), mean = vec3(0.0);
    for (uint i = 0u; i < BINS; ++i) {
        gaussian_lobe lobe = fetched.lobes[i];
        if (lobe.part < 1.0 / 64.0)
            continue;
        sum += lobe.part * reflect_projected(surface, fetched.filtered, shape_of(lobe));
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
