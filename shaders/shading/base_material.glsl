#ifndef BASE_MATERIAL_GLSL
#define BASE_MATERIAL_GLSL

// A material at one point of its maps, and its reflectance: what `direct` and the reference
// evaluate, and what all other filters should average.

#include "interface/mirrored.h"
#include "shading/albedo_table.glsl"
#include "shading/facet_pairs.glsl"
#include "lib/number/angle.glsl"
#include "lib/lobe/base_lobe.glsl"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/microfacet/microfacet.glsl"
#include "lib/map/normal_map.glsl"
#include "lib/lobe/normal_variance.glsl"
#include "lib/lobe/von_mises_fisher.glsl"
#include "shading/surface.glsl"

struct base_material {
    vec3 normal;   // in the tangent frame
    vec3 diffuse;  // albedo of the Lambert part
    vec3 specular; // microfacets: F0; half-vector lobes: factor of every lobe's colour
    float width;   // microfacets: the distribution's parameter; lobes: factor of their widths
    float variance; // of normals under the pixel, which widens the lobes; 0: none
    // The direction in which these vary most, a unit vector, and by how much more than on the mean
    // of it and across, relative to that mean, [0, 1].
    vec3 direction;
    float uneven;
};

// A lobe's parameter, widened by the spread of normals inside a texel.
float convolved(float parameter) {
    return NORMAL_CONCENTRATION
               ? convolved_parameter(DISTRIBUTION, parameter, material.normal_concentration)
               : parameter;
}

// The material's constants times the texels of its maps; a missing map counts as white.
base_material assemble_material(surface_point surface, vec3 normal, vec4 base_colour, vec4 width,
                                vec3 specular) {
    base_material base;
    vec3 albedo = material.base_colour.rgb * base_colour.rgb;
    if (VERTEX_COLOUR)
        albedo *= surface.colour.rgb;
    base.normal = normal;
    base.variance = isotropic_variance(surface.curvature);
    base.direction = vec3(0.0);
    base.uneven = 0.0;
    if (MODEL == MODEL_MICROFACET) {
        float metallic = material.metallic * (METALLIC_MAP ? width.b : 1.0);
        // glTF 2.0, appendix B.2: a dielectric reflects 4 % at normal incidence.
        base.diffuse = albedo * (1.0 - metallic);
        base.specular = mix(vec3(DIELECTRIC_F0), albedo, metallic);
        base.width = convolved(microfacet_parameter(DISTRIBUTION, material.roughness * width.g));
    } else {
        base.diffuse = albedo;
        base.specular = specular;
        base.width = width.r;
    }
    return base;
}

float half_vector_lobe_parameter(int i, float factor) {
    return convolved(base_lobe_parameter(DISTRIBUTION, material.lobe_direction[i].w * factor));
}

float widened_lobe_parameter(int i, base_material base) {
    return widened_parameter(DISTRIBUTION, half_vector_lobe_parameter(i, base.width),
                             base.variance);
}

// For microfacets. Masking uses the widened distribution too: tilted facets hide each other, and at
// a silhouette nothing else limits a broad distribution.
float widened_width(base_material base) {
    return widened_parameter(DISTRIBUTION, base.width, base.variance);
}

float evaluate_half_vector_lobe(vec3 half_vector, vec3 axis, float parameter) {
    return BASE_AS_LOBE ? von_mises_fisher(half_vector, axis,
                                           base_lobe_concentration(DISTRIBUTION, parameter))
                        : half_vector_lobe(DISTRIBUTION, half_vector, axis, parameter);
}

float evaluate_normal_distribution(vec3 normal, vec3 half_vector, float parameter) {
    return BASE_AS_LOBE
               ? distribution_von_mises_fisher(normal, half_vector,
                                               base_lobe_concentration(DISTRIBUTION, parameter))
               : normal_distribution(DISTRIBUTION, normal, half_vector, parameter);
}

// A lobe that normals make longer in one direction than across it is a round one of other half
// vectors, scaled along both (Heitz, Dupuy, Hill, Neubelt, 2016, Real-Time Polygonal-Light Shading
// with Linearly Transformed Cosines).
struct rounded_half_vector {
    vec3 half_vector;
    float area;   // over that of the same half vectors before
    float height; // of the half vector above the axis, over what it was before
};

// `own` is the parameter of the lobe without these normals, `widened` that of the round one.
rounded_half_vector rounded(base_material base, vec3 axis, vec3 half_vector, float own,
                            float widened) {
    if (base.uneven <= 0.0)
        return rounded_half_vector(half_vector, 1.0, 1.0);
    // What variance normals add, over that of both.
    float added = 1.0 - base_lobe_concentration(DISTRIBUTION, widened) /
                            max(base_lobe_concentration(DISTRIBUTION, own), 1e-6);
    float difference = base.uneven * clamp(added, 0.0, 1.0);
    // A normal that turns that way turns the axis with it.
    vec3 along = base.direction * dot(base.normal, axis) - base.normal * dot(base.direction, axis);
    along *= inversesqrt(max(dot(along, along), 1e-12));
    vec3 across = cross(axis, along);
    // Deviations become one.
    float shorter = inversesqrt(1.0 + difference);
    float longer = inversesqrt(max(1.0 - difference, 1e-6));
    vec3 scaled = half_vector + ((shorter - 1.0) * dot(half_vector, along)) * along +
                  ((longer - 1.0) * dot(half_vector, across)) * across;
    float height = inversesqrt(dot(scaled, scaled));
    return rounded_half_vector(height * scaled, shorter * longer * height * height * height,
                               height);
}

float evaluate_base_distribution(base_material base, vec3 half_vector) {
    float widened = widened_width(base);
    rounded_half_vector as_round = rounded(base, base.normal, half_vector, base.width, widened);
    return as_round.area * as_round.height *
           evaluate_normal_distribution(base.normal, as_round.half_vector, widened);
}

// The microfacet frame around any distribution of half vectors. `mean_normal` may be shorter than
// one: its product with the incoming direction is the mean of the texels' cosines.
vec3 evaluate_microfacets(base_material base, vec3 mean_normal, float distribution,
                          vec3 half_vector, vec3 outgoing, vec3 incoming) {
    float incoming_cosine = dot(base.normal, incoming);
    float outgoing_cosine = dot(base.normal, outgoing);
    if (incoming_cosine <= 0.0 || outgoing_cosine <= 0.0)
        return vec3(0.0);
    vec3 fresnel = fresnel_schlick(base.specular, vec3(1.0), dot(incoming, half_vector));
    float shadowing = masking_shadowing(DISTRIBUTION, incoming_cosine, outgoing_cosine, base.width);
    return microfacet_specular(fresnel, distribution, shadowing, outgoing_cosine) *
               scattering_scale(base.specular, outgoing_cosine, base.width) +
           microfacet_diffuse(base.diffuse, fresnel, dot(mean_normal, incoming));
}

// The colour of all half-vector lobes together, without the specular map.
vec3 lobes_colour() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        sum += material.lobe_colour[i].rgb;
    return sum;
}

// All lobes with their colours, without the specular map.
vec3 evaluate_half_vector_lobes(base_material base, vec3 halfway) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec3 axis = rotate_from_pole(base.normal, material.lobe_direction[i].xyz);
        float widened = widened_lobe_parameter(i, base);
        rounded_half_vector as_round =
            rounded(base, axis, halfway, half_vector_lobe_parameter(i, base.width), widened);
        sum += material.lobe_colour[i].rgb *
               (as_round.area * evaluate_half_vector_lobe(as_round.half_vector, axis, widened));
    }
    return sum;
}

mapped_facet facet_of_base(base_material base) {
    return mapped_facet(slope_of_normal(base.normal), base.specular, base.diffuse, base.specular,
                        widened_width(base), TURN_OF_FACET);
}

// Whether light from a direction can arrive at all. The plane of the frame is no horizon of
// displaced triangles, which face any direction.
bool arrives(vec3 incoming) {
    return DISPLACED || incoming.z > 0.0;
}

// Reflectance times cosine, for unit directions in the tangent frame. `mean_normal` is used for the
// Lambert part, as in evaluate_microfacets.
vec3 evaluate_base_material(base_material base, vec3 mean_normal, vec3 outgoing, vec3 incoming) {
    if (!arrives(incoming))
        return vec3(0.0);
    vec3 halfway = half_vector(incoming, outgoing);
    if (MODEL == MODEL_MICROFACET) {
        float distribution = evaluate_base_distribution(base, halfway);
        base.width = widened_width(base);
        return evaluate_microfacets(base, mean_normal, distribution, halfway, outgoing, incoming);
    }
    vec3 sum = base.specular * evaluate_half_vector_lobes(base, halfway);
    if (DIFFUSE)
        sum += microfacet_diffuse(base.diffuse, vec3(0.0), dot(mean_normal, incoming));
    return sum;
}

vec3 evaluate_base_material(base_material base, vec3 outgoing, vec3 incoming) {
    if (!CLOSED)
        return evaluate_base_material(base, base.normal, outgoing, incoming);
    mapped_facet facet = facet_of_base(base);
    base.diffuse = vec3(0.0);
    return unmasked_share(facet.slope, outgoing, incoming) *
               evaluate_base_material(base, base.normal, outgoing, incoming) +
           exchanged_and_diffuse(facet, outgoing, incoming);
}

#endif
