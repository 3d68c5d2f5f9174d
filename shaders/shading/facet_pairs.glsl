#ifndef FACET_PAIRS_GLSL
#define FACET_PAIRS_GLSL

// Microfacet materials whose mapped normals belong to closed surfaces: light that their facets
// exchange (lib/microfacet/facet_pair.glsl).

#include "lib/microfacet/facet_pair.glsl"
#include "lib/microfacet/slope_distribution.glsl"
#include "shading/albedo_table.glsl"

layout(constant_id = SPECIALISE_NORMAL_MAPPING) const uint NORMAL_MAPPING = NORMAL_MAPPING_CLASSIC;

// Half-vector lobes include their own masking.
bool closes_surface() {
    return NORMAL_MAPPING == NORMAL_MAPPING_MICROFACET && MODEL == MODEL_MICROFACET &&
           has_map(MAP_NORMAL);
}

// The mapped facet of a pair, and its material.
struct mapped_facet {
    vec2 slope;
    vec3 diffuse, f0;
    float width; // the distribution's parameter
};

struct facet_albedo {
    vec3 specular, diffuse;
};

// Together at most one, although a white Lambert part below smooth microfacets reflects more than
// is left for it (lib/microfacet/microfacet.glsl): exchanged light must not grow.
facet_albedo facet_albedo_at(mapped_facet facet, float cosine) {
    vec4 albedo = albedo_of(cosine, facet.width);
    vec3 reflected = specular_albedo(albedo, facet.f0, vec3(1.0)) *
                     scattering_scale(albedo, facet.f0);
    vec3 diffuse = diffuse_albedo(albedo, facet.diffuse, facet.f0, vec3(1.0));
    return facet_albedo(reflected, min(diffuse, max(1.0 - reflected, 0.0)));
}

float exchange_alpha(mapped_facet facet) {
    return alpha_for_masking(DISTRIBUTION, facet.width);
}

// Q: what meets the upright facet of a ray, at once or after the mapped one.
vec3 met_by_upright_facet(mapped_facet facet, vec3 direction) {
    vec2 shares = facet_pair_shares(facet.slope, direction);
    if (shares.x <= 0.0)
        return vec3(1.0);
    facet_albedo albedo =
        facet_albedo_at(facet, dot(normal_of_slope(facet.slope), direction));
    float microfacets =
        facet_pair_exchange_of_microfacets(facet.slope, direction, exchange_alpha(facet));
    return shares.y + shares.x * (albedo.specular * microfacets +
                                  albedo.diffuse * facet_pair_exchange(facet.slope));
}

// Schlick's Fresnel reflectance has its mean over all directions at this cosine.
const float MEAN_FRESNEL_COSINE = 0.456;

// What the mapped facet reflects towards the upright one, of light from all directions.
vec3 exchange_of_mapped_facet(mapped_facet facet) {
    facet_albedo albedo = facet_albedo_at(facet, MEAN_FRESNEL_COSINE);
    return albedo.specular * facet_pair_mean_exchange_of_microfacets(facet.slope,
                                                                     exchange_alpha(facet)) +
           albedo.diffuse * facet_pair_exchange(facet.slope);
}

// K.
vec3 gain_of_upright_facet(mapped_facet facet) {
    facet_albedo albedo = facet_albedo_at(facet, MEAN_FRESNEL_COSINE);
    return facet_pair_gain(facet.slope, albedo.specular + albedo.diffuse,
                           exchange_of_mapped_facet(facet));
}

// The light that both facets have exchanged: reflectance times cosine.
vec3 exchanged_light(mapped_facet facet, vec3 outgoing, vec3 incoming) {
    return met_by_upright_facet(facet, outgoing) * met_by_upright_facet(facet, incoming) *
           gain_of_upright_facet(facet) * (INVERSE_PI * max(incoming.z, 0.0));
}

// Factor of what the mapped facet reflects at once.
float unmasked_share(vec2 slope, vec3 outgoing, vec3 incoming) {
    return facet_pair_shares(slope, outgoing).x * facet_pair_masking(slope, incoming);
}

#endif
