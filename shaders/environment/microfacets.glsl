#ifndef ENVIRONMENT_MICROFACETS_GLSL
#define ENVIRONMENT_MICROFACETS_GLSL

// What microfacets about a normal of their own reflect of the environment.

#include "environment/broad_reflection.glsl"
#include "environment/irradiance.glsl"
#include "environment/lobes.glsl"
#include "environment/reflected_lobes.glsl"
#include "lib/microfacet/reflection_lobe.glsl"

// A lobe is broader than base lobes of this parameter because the normals vary. If both are
// Gaussian, the mean normal of the facets that reflect about a half vector lies between the axis
// and the half vector. [0, 1]: how far.
float spread_of_normals(direction_lobe lobe, float parameter) {
    float base = 1.0 / base_lobe_concentration(DISTRIBUTION, parameter);
    return 1.0 - min(base / max(lobe_variance(lobe), 1e-10), 1.0);
}

// `masked`: by the other facet of each normal's pair.
vec3 sampled_microfacets(surface_point surface, half_vector_distribution lobe, vec3 f0,
                         float parameter, bool masked) {
    float spread = spread_of_normals(lobe.shape, parameter);
    float mean_cosine = dot(lobe.shape.axis, surface.outgoing);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint j = 0u; j < ENVIRONMENT_GRID; ++j) {
        for (uint k = 0u; k < ENVIRONMENT_GRID; ++k) {
            half_vector_sample point = sample_of(lobe, j, k, spread);
            float half_cosine = dot(surface.outgoing, point.half_vector);
            vec3 incoming = 2.0 * half_cosine * point.half_vector - surface.outgoing;
            vec3 normal = normalize(mix(lobe.shape.axis, point.half_vector, spread));
            float outgoing_cosine = max(dot(normal, surface.outgoing), 1e-3);
            float visible = masking_shadowing(DISTRIBUTION, dot(normal, incoming), outgoing_cosine,
                                              parameter);
            float scale = max(half_cosine, 0.0) /
                          (outgoing_cosine * max(dot(normal, point.half_vector), 1e-3));
            float seen = above_horizon(incoming) ? visible * scale : 0.0;
            if (masked)
                seen *= unmasked_share(slope_of_normal(normal), surface.outgoing, incoming);
            vec3 fresnel = fresnel_schlick(f0, vec3(1.0), half_cosine);
            sum += point.weight * seen * fresnel * sample_radiance(surface, point, incoming);
            weights += point.weight;
        }
    }
    return sum * (scattering_scale(f0, mean_cosine, parameter) / weights);
}

// ---------------------------------------------------------------------------------------------
// The lobe of incoming directions

// About a normal that is the same everywhere.
direction_lobe incoming_lobe(reflection_lobe base, vec3 normal, vec3 outgoing) {
    vec3 forward = -perpendicular_towards(normal, outgoing);
    float cosine = cos(base.angle), sine = sin(base.angle);
    return direction_lobe(cosine * normal + sine * forward,
                          base.along * (cosine * forward - sine * normal),
                          base.across * cross(normal, forward));
}

// The part of a lobe of half vectors that is due to varying normals: the rest has the variance of
// base lobes.
direction_lobe lobe_of_normals(direction_lobe half_vectors, float base_variance) {
    direction_lobe lobe = principal_lobe(half_vectors);
    lobe.first *= sqrt(max(1.0 - base_variance / max(dot(lobe.first, lobe.first), 1e-20), 0.0));
    lobe.second *= sqrt(max(1.0 - base_variance / max(dot(lobe.second, lobe.second), 1e-20), 0.0));
    return lobe;
}

// Adds a covariance to a lobe's, across its axis.
direction_lobe broadened_lobe(direction_lobe lobe, vec3 first, vec3 second) {
    vec3 u = normalize(lobe.first), v = normalize(lobe.second);
    vec2 a = vec2(dot(first, u), dot(first, v)), b = vec2(dot(second, u), dot(second, v));
    float x = sqrt(dot(lobe.first, lobe.first) + a.x * a.x + b.x * b.x);
    float mixed = (a.x * a.y + b.x * b.y) / x;
    float rest = dot(lobe.second, lobe.second) + a.y * a.y + b.y * b.y - mixed * mixed;
    return direction_lobe(lobe.axis, x * u + mixed * v, sqrt(max(rest, 1e-12)) * v);
}

// The axis is a(c) n - b(c) o, c = <n, o>, and turns with the normal: to first order by
//   a dn + 2 b <o, dn> n,
// which is exact for a mirror, where a = 2 c and b = 1, and for a surface that reflects the same
// for all views, where b = 0.
vec3 turned_by(vec3 step, vec3 normal, vec3 outgoing, float along_normal, float against_viewer) {
    return along_normal * step + (2.0 * against_viewer * dot(outgoing, step)) * normal;
}

direction_lobe incoming_lobe_of_normals(reflection_lobe base, direction_lobe normals,
                                        vec3 outgoing) {
    direction_lobe lobe = incoming_lobe(base, normals.axis, outgoing);
    float cosine = clamp(dot(normals.axis, outgoing), 0.0, 1.0);
    float sine = sqrt(1.0 - cosine * cosine);
    float against_viewer = sine > 1e-3 ? sin(base.angle) / sine : 1.0;
    float along_normal = cos(base.angle) + against_viewer * cosine;
    return broadened_lobe(
        lobe, turned_by(normals.first, normals.axis, outgoing, along_normal, against_viewer),
        turned_by(normals.second, normals.axis, outgoing, along_normal, against_viewer));
}

// ---------------------------------------------------------------------------------------------
// Horizons

// What a plane cuts off a lobe whose height above it is a normal number: lobe_above() of
// lib/lobe/direction_lobe.glsl in parts.
struct horizon_cut {
    float share;    // what is left
    vec3 shift;     // of the axis
    float variance; // of the height, relative to the whole lobe's
};

// `scale`: of the height in standard deviations.
horizon_cut cut_by_plane(direction_lobe lobe, vec3 plane_normal, float scale) {
    float a = dot(lobe.first, plane_normal), b = dot(lobe.second, plane_normal);
    float deviation = sqrt(max(a * a + b * b, 1e-12));
    float x = max(scale * dot(lobe.axis, plane_normal) / deviation, -3.0);
    float share = normal_below(x), mean = normal_density(x) / max(share, 1e-3);
    return horizon_cut(share, (mean / deviation) * (a * lobe.first + b * lobe.second),
                       clamp(1.0 - mean * (mean + x), 0.05, 1.0));
}

// Normals are Gaussian as slopes, and a direction's angle is twice theirs: at the angle e above the
// plane, 2 tan(e/2) takes the place of tan(e).
horizon_cut cut_by_horizon(direction_lobe lobe, vec3 plane_normal) {
    float height = clamp(dot(lobe.axis, plane_normal), -1.0, 1.0);
    float level = sqrt(1.0 - height * height);
    return cut_by_plane(lobe, plane_normal, 2.0 * level / (1.0 + level));
}

// The same where a relief hides light: of directions lower than `top`, in proportion to their
// height. 0: a plane.
horizon_cut cut_by_relief(direction_lobe lobe, vec3 plane_normal, float top) {
    if (top <= 0.0)
        return cut_by_horizon(lobe, plane_normal);
    float a = dot(lobe.first, plane_normal), b = dot(lobe.second, plane_normal);
    float deviation = sqrt(max(a * a + b * b, 1e-12));
    float height = dot(lobe.axis, plane_normal);
    faded_part part = faded_below(height / deviation, top / deviation);
    return horizon_cut(part.share, (part.shift / deviation) * (a * lobe.first + b * lobe.second),
                       part.variance);
}

// The same of facets as large as they appear from where `plane_normal` points; `share` is that of
// facets that face it.
horizon_cut cut_by_area(direction_lobe lobe, vec3 plane_normal) {
    float a = dot(lobe.first, plane_normal), b = dot(lobe.second, plane_normal);
    float deviation = sqrt(max(a * a + b * b, 1e-12));
    float x = clamp(dot(lobe.axis, plane_normal) / deviation, -3.0, 10.0);
    float share = normal_below(x), density = normal_density(x);
    float area = max(x * share + density, 1e-4), mean = share / area;
    return horizon_cut(share, (mean / deviation) * (a * lobe.first + b * lobe.second),
                       clamp(1.0 + density / area - mean * mean, 0.05, 1.0));
}

// A lobe moved by `shift` towards `up` and made narrower in that direction.
direction_lobe moved_lobe(direction_lobe lobe, vec3 up, float shift, float variance) {
    float narrower = sqrt(variance) - 1.0;
    return direction_lobe(normalize(lobe.axis + shift * up),
                          lobe.first + (narrower * dot(lobe.first, up)) * up,
                          lobe.second + (narrower * dot(lobe.second, up)) * up);
}

vec3 direction_of(vec3 shift) {
    return shift * inversesqrt(max(dot(shift, shift), 1e-20));
}

// `own` is the lobe without varying normals, which the horizon of its own normal has already cut:
// the surface's horizon takes only what lies beyond. `top`: see cut_by_relief(). Scales
// `share`, but for a relief, of which the caller knows the share.
direction_lobe lobe_above_surface(direction_lobe lobe, direction_lobe own, vec3 normal, float top,
                                  inout float share) {
    if (HORIZON == HORIZON_IGNORED)
        return lobe;
    horizon_cut before = cut_by_horizon(own, normal);
    horizon_cut cut = cut_by_relief(lobe, SURFACE_NORMAL, top);
    if (top <= 0.0)
        share *= min(cut.share / max(before.share, 0.05), 1.0);
    if (HORIZON == HORIZON_FADED)
        return lobe;
    vec3 up = direction_of(cut.shift);
    return moved_lobe(lobe, up, max(dot(cut.shift - before.shift, up), 0.0),
                      min(cut.variance / before.variance, 1.0));
}

// Facets that face away reflect nothing: the lobe of the normals that are left, and their share.
direction_lobe facing_lobe(direction_lobe normals, vec3 outgoing, bool by_area,
                           out float share) {
    horizon_cut cut =
        by_area ? cut_by_area(normals, outgoing) : cut_by_plane(normals, outgoing, 1.0);
    share = cut.share;
    return moved_lobe(normals, direction_of(cut.shift), length(cut.shift), cut.variance);
}

// ---------------------------------------------------------------------------------------------
// Reflection

// Karis, 2013, Real Shading in Unreal Engine 4: the product of two integrals, the reflection of a
// white environment and the mean of the environment over the lobe. The albedo for a white
// environment accounts for the base lobes' own horizon, but not for the surface's.

// The lobe about the mirror direction.
vec3 microfacets_by_mip(surface_point surface, half_vector_distribution lobe, vec3 f0,
                        float parameter) {
    vec3 normal = lobe.shape.axis;
    float outgoing_cosine = dot(normal, surface.outgoing);
    vec3 reflected = specular_albedo(albedo_of(outgoing_cosine, parameter), f0, vec3(1.0)) *
                     scattering_scale(f0, outgoing_cosine, parameter);
    direction_lobe incoming = reflected_lobe(lobe.shape, surface.outgoing);
    if (HORIZON != HORIZON_IGNORED && !CLOSED) {
        float own = max(lobe_share_above(incoming, normal), 0.05);
        reflected *= min(lobe_share_above(incoming, SURFACE_NORMAL) / own, 1.0);
    }
    if (HORIZON == HORIZON_CLIPPED)
        incoming = lobe_above(lobe_above(incoming, normal), SURFACE_NORMAL);
    return reflected * lobe_radiance(surface, lobe, incoming);
}

// Of light from above a normal, what lies below the surface.
vec3 below_surface(surface_point surface, vec3 normal) {
    if (HORIZON == HORIZON_IGNORED || CLOSED || !has_map(MAP_NORMAL))
        return vec3(0.0);
    return irradiance_from_below(surface, normal);
}

// Shares of the ways in which reflected light is found, [0, 1] each; the rest is a lobe.
struct reflection_shares {
    float lobes;      // as a sum of lobes
    float polynomial; // as a lobe and a polynomial over the hemisphere
};

// Dielectrics, whose light is mostly diffuse, reflect a lobe, and so do narrow lobes and those of
// normals that vary more than microfacets do: a sum about their mean ends at none of their
// horizons.
reflection_shares shares_of_reflection(vec3 f0, float roughness, float variance_of_normals) {
    if (BROAD_REFLECTION == 0u || roughness <= REFLECTED_LOBES_LEAST_ROUGHNESS)
        return reflection_shares(0.0, 0.0);
    float alpha = roughness * roughness;
    float even = 1.0 - smoothstep(0.05, 0.3, variance_of_normals / (alpha * alpha));
    float whole = even * smoothstep(REFLECTED_LOBES_LEAST_ROUGHNESS,
                                    REFLECTED_LOBES_FULL_ROUGHNESS, roughness) *
                  smoothstep(BROAD_LEAST_F0, BROAD_FULL_F0, max(max(f0.r, f0.g), f0.b));
    float polynomial = BROAD_REFLECTION == (REFLECTED_AS_LOBES | REFLECTED_AS_POLYNOMIAL)
                           ? smoothstep(BROAD_LEAST_ROUGHNESS, BROAD_FULL_ROUGHNESS, roughness)
                           : float(BROAD_REFLECTION / REFLECTED_AS_POLYNOMIAL);
    return reflection_shares(whole * (1.0 - polynomial), whole * polynomial);
}

// What surfaces reflect to where they are seen from: a lobe, and what comes from everywhere.
struct facing_reflection {
    vec3 lobe;     // factor of the mean over the lobe
    vec3 gathered; // radiance
};

// Replaces the lobe's factor and the light of Lambert's law.
facing_reflection broad_facing_reflection(surface_point surface, vec3 normal, uint kind, vec3 f0,
                                          vec4 albedo, float roughness) {
    float cosine = dot(normal, surface.outgoing);
    broad_part part = broad_reflection(kind, cosine, roughness, 0.0);
    broad_part part_90 = broad_reflection(kind, cosine, roughness, 1.0);
    broad_light light = gather_broadly(surface, normal, part, part_90);
    vec3 below = below_surface(surface, normal);
    light.f0 -= (1.0 - part.lobe) * below;
    light.f90 -= (1.0 - part_90.lobe) * below;
    return facing_reflection(f0 * (albedo.x * part.lobe) + albedo.y * part_90.lobe,
                             f0 * (albedo.x * light.f0) + albedo.y * light.f90);
}

// How much of a lobe has the long tails of the base lobe: its part of the variance. Normals vary by
// `variance`, half of it each way.
float tails_of_base(float variance, float roughness) {
    float alpha = roughness * roughness;
    return alpha * alpha / max(alpha * alpha + variance, 1e-10);
}

// The lobe that is fitted to what microfacets reflect, and light as rough surfaces gather it.
// `broad`: how much of it is a lobe and a polynomial instead [0, 1]. `top`: see cut_by_relief().
vec3 reflect_as_lobe(surface_point surface, direction_lobe normals, uint kind, vec3 f0,
                     vec4 albedo, float roughness, float broad, bool spread_out, float top) {
    float cosine = dot(normals.axis, surface.outgoing);
    float tails = float(kind == DISTRIBUTION_GGX ||
                        (BROAD_REFLECTION != 0u && kind == DISTRIBUTION_VMF &&
                         DISTRIBUTION == DISTRIBUTION_GGX));
    if (top > 0.0)
        tails *= tails_of_base(dot(normals.first, normals.first) +
                                   dot(normals.second, normals.second), roughness);
    reflection_lobe base = lobe_of_reflection(tails, cosine, roughness);
    const float diffuse_share = base.diffuse_share;
    facing_reflection reflection;
    reflection.lobe = f0 * (albedo.x * (1.0 - diffuse_share)) + albedo.y;
    // All colours of broad reflection share one lobe.
    vec3 mixed = mix(reflection.lobe, vec3(albedo.x * (1.0 - diffuse_share) + albedo.y), broad);
    base = mixed_lobe(base, lobe_of_grazing_reflection(cosine, roughness),
                      3.0 * albedo.y / max(mixed.r + mixed.g + mixed.b, 1e-10));
    bool polynomial = (BROAD_REFLECTION & REFLECTED_AS_POLYNOMIAL) != 0u && broad > 0.0;
    if (polynomial)
        base = completed_lobe(base, cosine, broad);
    direction_lobe own = incoming_lobe(base, normals.axis, surface.outgoing), incoming = own;
    float resultant = 1.0;
    if (spread_out) {
        incoming = incoming_lobe_of_normals(base, normals, surface.outgoing);
        resultant = max(1.0 - 0.5 * (dot(normals.first, normals.first) +
                                     dot(normals.second, normals.second)), 0.3);
    }
    float share = 1.0;
    incoming = lobe_above_surface(incoming, own, normals.axis, top, share);
    if (CLOSED)
        share = 1.0;
    reflection.gathered = broad < 1.0 ? f0 * (albedo.x * diffuse_share) *
                                            irradiance_above(surface, resultant * normals.axis)
                                      : vec3(0.0);
    if (polynomial) {
        facing_reflection other =
            broad_facing_reflection(surface, normals.axis, kind, f0, albedo, roughness);
        reflection.lobe = mix(reflection.lobe, other.lobe, broad);
        reflection.gathered = mix(reflection.gathered, other.gathered, broad);
    }
    vec3 sum = reflection.gathered +
               share * reflection.lobe *
                   lobe_radiance(surface, half_vector_distribution(normals, kind), incoming);
    return max(sum, 0.0);
}

vec3 reflect_facing(surface_point surface, direction_lobe normals, uint kind, vec3 f0,
                    float parameter, bool spread_out, float top) {
    float cosine = dot(normals.axis, surface.outgoing);
    if (cosine <= 0.0)
        return vec3(0.0);
    float roughness = roughness_from_parameter(DISTRIBUTION, parameter);
    float variance = spread_out ? dot(normals.first, normals.first) +
                                      dot(normals.second, normals.second)
                                : 0.0;
    reflection_shares shares = shares_of_reflection(f0, roughness, variance);
    vec4 albedo = albedo_of_lobe(kind, cosine, parameter);
    vec3 sum = vec3(0.0);
    if ((BROAD_REFLECTION & REFLECTED_AS_LOBES) != 0u)
        sum = (f0 * albedo.x + albedo.y) *
              light_of_reflected_lobes(surface, normals.axis, kind, f0, roughness, 0.5 * variance,
                                       HORIZON != HORIZON_IGNORED && has_map(MAP_NORMAL),
                                       shares.lobes);
    float rest = 1.0 - shares.lobes;
    if (rest > 0.0)
        sum += rest * reflect_as_lobe(surface, normals, kind, f0, albedo, roughness,
                                      shares.polynomial / rest, spread_out, top);
    return scattering_scale(albedo, f0) * sum;
}

// Normals that vary by much see different parts of the sky and different horizons. Very rough lobes
// share one bin, whatever their normals. Below a roughness of 0.8, parts change means by 2 % at
// most, and are not worth their time.
struct normal_parts {
    uint count;
    float offset; // along either axis, in deviations
};

normal_parts parts_of_normals(direction_lobe normals, float roughness) {
    float variance = dot(normals.first, normals.first) + dot(normals.second, normals.second);
    float offset = 0.8 * smoothstep(0.05, 0.3, variance) * smoothstep(0.8, 0.9, roughness);
    return normal_parts(offset > 0.0 ? 4u : 1u, offset);
}

// One of four narrower lobes, which together have the mean and the variance of the whole.
direction_lobe part_of_normals(direction_lobe normals, normal_parts parts, uint index) {
    vec2 place = parts.offset * vec2((index & 1u) == 0u ? -1.0 : 1.0, index < 2u ? -1.0 : 1.0);
    vec3 step = place.x * normals.first + place.y * normals.second;
    float square = min(dot(step, step), 3.0);
    vec3 axis = normalize((1.0 - 0.5 * square) * normals.axis + sqrt(1.0 - 0.25 * square) * step);
    float narrower = sqrt(1.0 - parts.offset * parts.offset);
    vec3 turned = (normals.axis + axis) / (1.0 + dot(normals.axis, axis));
    return direction_lobe(axis, narrower * (normals.first - dot(normals.first, axis) * turned),
                          narrower * (normals.second - dot(normals.second, axis) * turned));
}

// How normals that vary are seen, and what they see.
struct facet_view {
    bool in_parts; // where normals vary by much, light is found for four parts of them
    bool by_area;  // each counts as large as it appears, not all alike
    float top;     // see cut_by_relief()
};

const facet_view VIEW_OF_MAP = facet_view(false, false, 0.0);
const facet_view VIEW_OF_BIN = facet_view(true, false, 0.0);

vec3 prefiltered_microfacets(surface_point surface, half_vector_distribution lobe, vec3 f0,
                             float parameter, facet_view view) {
    direction_lobe normals =
        lobe_of_normals(lobe.shape, 1.0 / base_lobe_concentration(DISTRIBUTION, parameter));
    normal_parts parts = normal_parts(1u, 0.0);
    if (view.in_parts)
        parts = parts_of_normals(normals, roughness_from_parameter(DISTRIBUTION, parameter));
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < parts.count; ++i) {
        float share;
        direction_lobe facing =
            facing_lobe(view.in_parts ? part_of_normals(normals, parts, i) : normals,
                        surface.outgoing, view.by_area, share);
        if (CLOSED)
            share = 1.0;
        sum += share * reflect_facing(surface, facing, lobe.kind, f0, parameter, true, view.top);
    }
    return sum / float(parts.count);
}

// `parameter` is that of the base lobes and determines masking. Of closed surfaces, samples include
// which part of the light passes the upright facets; the other methods return what is reflected if
// all of it does. `view`: by the default method alone.
vec3 reflect_microfacets(surface_point surface, half_vector_distribution lobe, vec3 f0,
                         float parameter, facet_view view) {
    if (sampled_by_grid())
        return sampled_microfacets(surface, lobe, f0, parameter, CLOSED);
    return ENVIRONMENT_METHOD == ENVIRONMENT_MIP
               ? microfacets_by_mip(surface, lobe, f0, parameter)
               : prefiltered_microfacets(surface, lobe, f0, parameter, view);
}

vec3 reflect_microfacets(surface_point surface, half_vector_distribution lobe, vec3 f0,
                         float parameter) {
    return reflect_microfacets(surface, lobe, f0, parameter, VIEW_OF_MAP);
}

// Of one normal. A branch for it above would have a device that runs both sides of branches reflect
// everything twice.
vec3 reflect_base_microfacets(surface_point surface, vec3 normal, vec3 f0, float parameter) {
    half_vector_distribution lobe = base_half_vectors(normal, parameter, surface.outgoing);
    return ENVIRONMENT_METHOD == ENVIRONMENT_PREFILTERED
               ? reflect_facing(surface, lobe.shape, lobe.kind, f0, parameter, false, 0.0)
               : reflect_microfacets(surface, lobe, f0, parameter);
}

#endif
