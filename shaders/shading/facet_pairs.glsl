#ifndef FACET_PAIRS_GLSL
#define FACET_PAIRS_GLSL

// Microfacet materials whose mapped normals belong to closed surfaces (the variant CLOSED_SURFACE):
// light that their facets exchange (lib/microfacet/facet_pair.glsl).

#include "lib/microfacet/facet_pair.glsl"
#include "lib/microfacet/microfacet.glsl"
#include "lib/microfacet/slope_distribution.glsl"
#include "lib/number/angle.glsl"
#include "shading/albedo_table.glsl"

// A literal, so that shaders for other surfaces contain no code for these.
#ifdef CLOSED_SURFACE
#define CLOSED true
#else
#define CLOSED false
#endif

// The mapped facet of a pair, and its material.
struct mapped_facet {
    vec2 slope;
    vec3 f0, diffuse;
    vec3 cover;  // F0 of what covers the Lambert part
    float width; // the distribution's parameter
    float turn;  // of the microfacets by which exchange is determined
};

// Other turns make the sums of all that facets exchange up to 5 % too large; with this one they are
// at most 2.4 % off, and 0.7 % on average.
const int VISIBLE_NORMALS = 12;
const float TURN_OF_FACET = 0.4;

// A Gaussian of slopes is represented by nodes of equal weight, at these places in standard
// deviations: a Fibonacci lattice of variance one. What facets exchange has a kink where they turn
// away from the viewer or the light, which a product of three or five Gauss-Hermite nodes gets
// wrong by up to half at grazing angles; this is at most 5 % off (slopes up to 0.8).
const int SLOPE_NODES = 20;

vec2 slope_node(int i) {
    vec2 point = lattice_point(i, SLOPE_NODES, 0.0);
    float variance = 1.0 - 0.3466 / float(SLOPE_NODES); // of a lattice without this factor
    float radius = sqrt(-2.0 / variance * log(1.0 - point.x)), angle = 2.0 * PI * point.y;
    return radius * vec2(cos(angle), sin(angle));
}

// Nodes differ in the microfacets that stand for all.
float turn_of_node(int i) {
    return 0.755 * float(i);
}

struct facet_albedo {
    vec3 specular, diffuse;
};

// Together at most one, although a white Lambert part below smooth microfacets reflects more than
// is left for it (lib/microfacet/microfacet.glsl): exchanged light must not grow.
facet_albedo facet_albedo_at(mapped_facet facet, float cosine) {
    vec4 albedo = albedo_of(cosine, facet.width);
    vec3 reflected = specular_albedo(albedo, facet.f0, vec3(1.0)) *
                     scattering_scale(albedo, facet.f0);
    vec3 diffuse = diffuse_albedo(albedo, facet.diffuse, facet.cover, vec3(1.0));
    return facet_albedo(reflected, min(diffuse, max(1.0 - reflected, 0.0)));
}

float exchange_alpha(mapped_facet facet) {
    return alpha_for_masking(DISTRIBUTION, facet.width);
}

float exchange_of_microfacets(mapped_facet facet, vec3 direction) {
    return facet_pair_exchange_of_microfacets(facet.slope, direction, exchange_alpha(facet),
                                              VISIBLE_NORMALS, facet.turn);
}

// Q: what meets the upright facet of a ray, at once or after the mapped one.
vec3 met_by_upright_facet(mapped_facet facet, vec3 direction) {
    vec2 shares = facet_pair_shares(facet.slope, direction);
    if (shares.x <= 0.0)
        return vec3(1.0);
    facet_albedo albedo =
        facet_albedo_at(facet, dot(normal_of_slope(facet.slope), direction));
    float microfacets = exchange_of_microfacets(facet, direction);
    return shares.y + shares.x * (albedo.specular * microfacets +
                                  albedo.diffuse * facet_pair_exchange(facet.slope));
}

// Schlick's Fresnel reflectance has its mean over all directions at this cosine.
const float MEAN_FRESNEL_COSINE = 0.456;

// Of light from all directions.
facet_albedo mean_albedo_of_facet(mapped_facet facet) {
    return facet_albedo_at(facet, MEAN_FRESNEL_COSINE);
}

// What the mapped facet reflects towards the upright one, of light from all directions.
vec3 exchange_of_mapped_facet(mapped_facet facet, facet_albedo albedo) {
    return albedo.specular * facet_pair_mean_exchange_of_microfacets(facet.slope,
                                                                     exchange_alpha(facet)) +
           albedo.diffuse * facet_pair_exchange(facet.slope);
}

// K.
vec3 gain_of_upright_facet(mapped_facet facet) {
    facet_albedo albedo = mean_albedo_of_facet(facet);
    return facet_pair_gain(facet.slope, albedo.specular + albedo.diffuse,
                           exchange_of_mapped_facet(facet, albedo));
}

// Factor of what the mapped facet reflects at once.
float unmasked_share(vec2 slope, vec3 outgoing, vec3 incoming) {
    return facet_pair_shares(slope, outgoing).x * facet_pair_masking(slope, incoming);
}

// What does not depend on the light: Q of the viewer, and K.
struct facet_exchange {
    vec3 seen, gain;
};

facet_exchange exchange_seen(mapped_facet facet, vec3 outgoing) {
    return facet_exchange(met_by_upright_facet(facet, outgoing), gain_of_upright_facet(facet));
}

// Of reflectance times cosine, light that the facets exchange and the mapped one's Lambert part.
vec3 exchanged_and_diffuse(mapped_facet facet, facet_exchange exchange, vec3 outgoing,
                           vec3 incoming) {
    vec3 sum = exchange.seen * met_by_upright_facet(facet, incoming) * exchange.gain *
               (INVERSE_PI * max(incoming.z, 0.0));
    if (!DIFFUSE)
        return sum;
    vec3 fresnel = fresnel_schlick(facet.cover, vec3(1.0),
                                   dot(incoming, half_vector(incoming, outgoing)));
    return sum + unmasked_share(facet.slope, outgoing, incoming) *
                     microfacet_diffuse(facet.diffuse, fresnel,
                                        dot(normal_of_slope(facet.slope), incoming));
}

vec3 exchanged_and_diffuse(mapped_facet facet, vec3 outgoing, vec3 incoming) {
    return exchanged_and_diffuse(facet, exchange_seen(facet, outgoing), outgoing, incoming);
}

// Masking of a texel's microfacets and of its facets, over 4 <n, omega_o>.
float visibility_of_texel(vec2 slope, float width, vec3 outgoing, vec3 incoming) {
    vec3 normal = normal_of_slope(slope);
    return 0.25 *
           masking_shadowing(DISTRIBUTION, dot(normal, incoming), dot(normal, outgoing), width) *
           facet_pair_visibility(slope, outgoing, incoming);
}

#endif
