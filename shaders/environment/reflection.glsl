#ifndef ENVIRONMENT_REFLECTION_GLSL
#define ENVIRONMENT_REFLECTION_GLSL

// What a base material reflects of the environment.

#include "environment/microfacets.glsl"

// ---------------------------------------------------------------------------------------------
// Lambert's part

// The albedo of what microfacets let through: 1 - F = (1 - F0) (1 - (1 - c)^5).
vec3 let_through(surface_point surface, base_material base) {
    if (MODEL != MODEL_MICROFACET)
        return base.diffuse;
    vec4 albedo = albedo_of(dot(base.normal, surface.outgoing), base.width);
    return diffuse_albedo(albedo, base.diffuse, base.specular, vec3(1.0));
}

vec3 reflect_lambert(surface_point surface, base_material base, vec3 mean_normal) {
    return let_through(surface, base) * lambert_irradiance(surface, mean_normal);
}

// ---------------------------------------------------------------------------------------------
// Its lobes

vec3 reflect_base_specular(surface_point surface, base_material base) {
    if (MODEL == MODEL_MICROFACET)
        return reflect_base_microfacets(surface, base.normal, base.specular, widened_width(base));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec3 axis = rotate_from_pole(base.normal, material.lobe_direction[i].xyz);
        float parameter = widened_lobe_parameter(i, base);
        sum += material.lobe_colour[i].rgb *
               reflect_half_vectors(surface, base_half_vectors(axis, parameter, surface.outgoing));
    }
    return base.specular * sum;
}

// ---------------------------------------------------------------------------------------------
// Closed surfaces (shading/facet_pairs.glsl)

// What of the light that the mapped facet's microfacets reflect passes the upright facet.
float passing_microfacets(mapped_facet facet, vec3 outgoing) {
    return facet_pair_shares(facet.slope, outgoing).x *
           (1.0 - exchange_of_microfacets(facet, outgoing));
}

// Irradiance of both facets over pi, times their areas: the integrals of the light from above times
//   a_p <w_p, u> G_1(u) = max(u_z - s u_xy, 0) - max(-s u_xy, 0)
// and times the rest of u_z.
struct facet_irradiance {
    vec3 mapped, upright;
};

facet_irradiance irradiance_of_facets(surface_point surface, vec2 slope) {
    float square = dot(slope, slope);
    vec2 down = square > 0.0 ? -slope * inversesqrt(square) : vec2(1.0, 0.0);
    vec3 all = irradiance_above(surface, SURFACE_NORMAL);
    vec3 mapped =
        sqrt(1.0 + square) * irradiance_above(surface, normal_of_slope(slope)) -
        sqrt(square) * irradiance_above(surface, vec3(down, 0.0));
    mapped = clamp(mapped, vec3(0.0), all);
    return facet_irradiance(mapped, all - mapped);
}

// Lambert's part and exchanged light.
vec3 reflect_facet_pair(surface_point surface, mapped_facet facet) {
    facet_irradiance irradiance = irradiance_of_facets(surface, facet.slope);
    vec3 normal = normal_of_slope(facet.slope);
    vec3 met = irradiance.upright +
               exchange_of_mapped_facet(facet, mean_albedo_of_facet(facet)) * irradiance.mapped;
    vec3 sum = met_by_upright_facet(facet, surface.outgoing) * gain_of_upright_facet(facet) * met;
    if (DIFFUSE) {
        vec4 albedo = albedo_of(dot(normal, surface.outgoing), facet.width);
        sum += facet_pair_shares(facet.slope, surface.outgoing).x * normal.z *
               diffuse_albedo(albedo, facet.diffuse, facet.cover, vec3(1.0)) * irradiance.mapped;
    }
    return sum;
}

vec3 reflect_closed_material(surface_point surface, base_material base) {
    mapped_facet facet = facet_of_base(base);
    vec3 reflected = reflect_base_specular(surface, base);
    if (!sampled_by_grid())
        reflected *= passing_microfacets(facet, surface.outgoing);
    return reflected + reflect_facet_pair(surface, facet);
}

// The facets of a footprint.
struct facet_sum {
    vec3 reflected; // by Lambert's part, and exchanged
    float passing;  // how much of what their microfacets reflect passes the upright facets
    // Of the normals, by how much of that passes:
    vec3 normal;
    mat3 second_moments;
};

facet_sum no_facets() {
    return facet_sum(vec3(0.0), 0.0, vec3(0.0), mat3(0.0));
}

void add_facet(inout facet_sum sum, surface_point surface, mapped_facet facet) {
    float part = 1.0 / float(SLOPE_NODES);
    float passing = part * passing_microfacets(facet, surface.outgoing);
    vec3 normal = normal_of_slope(facet.slope);
    sum.reflected += part * reflect_facet_pair(surface, facet);
    sum.passing += passing;
    sum.normal += passing * normal;
    sum.second_moments += passing * outerProduct(normal, normal);
}

direction_lobe lobe_of_passing(facet_sum sum, vec3 outgoing) {
    vec3 axis = normalize(sum.normal);
    vec3 along = perpendicular_towards(axis, outgoing), across = cross(axis, along);
    vec3 image = sum.second_moments * along / sum.passing;
    float deviation = sqrt(max(dot(along, image), 1e-12));
    float mixed = dot(across, image) / deviation;
    float rest = dot(across, sum.second_moments * across) / sum.passing - mixed * mixed;
    return direction_lobe(axis, deviation * along + mixed * across,
                          sqrt(max(rest, 1e-12)) * across);
}

// Lit by what the normals that the viewer sees reflect. `parameter` is that of the microfacets.
vec3 reflect_facets(surface_point surface, facet_sum sum, uint kind, vec3 f0, float parameter) {
    if (sum.passing < 1e-6)
        return sum.reflected;
    direction_lobe normals = lobe_of_passing(sum, surface.outgoing);
    if (ENVIRONMENT_METHOD == ENVIRONMENT_MIP || sampled_by_grid()) {
        direction_lobe base =
            base_half_vectors(normals.axis, parameter, surface.outgoing).shape;
        normals = broadened_lobe(normals, base.first, base.second);
        half_vector_distribution lobe = half_vector_distribution(normals, kind);
        return sum.reflected +
               sum.passing * (sampled_by_grid()
                                  ? sampled_microfacets(surface, lobe, f0, parameter, false)
                                  : microfacets_by_mip(surface, lobe, f0, parameter));
    }
    return sum.reflected +
           sum.passing * reflect_facing(surface, normals, kind, f0, parameter, true, 0.0);
}

// ---------------------------------------------------------------------------------------------
// A base material

vec3 reflect_base_material(surface_point surface, base_material base, vec3 mean_normal) {
    if (CLOSED)
        return reflect_closed_material(surface, base);
    vec3 sum = reflect_base_specular(surface, base);
    // Facets that face away are black, as under lights.
    bool seen = MODEL != MODEL_MICROFACET || dot(base.normal, surface.outgoing) > 0.0;
    if (DIFFUSE && seen)
        sum += reflect_lambert(surface, base, mean_normal);
    return sum;
}

#endif
