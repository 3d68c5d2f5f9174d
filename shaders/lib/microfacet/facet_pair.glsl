#ifndef LIB_FACET_PAIR_GLSL
#define LIB_FACET_PAIR_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "lib/microfacet/masking.glsl"
#include "lib/number/constants.glsl"

// Schuessler, Heitz, Hanika, Dachsbacher, 2017, Microfacet-based Normal Mapping for Robust Monte
// Carlo Path Tracing: a texel's facet p, of normal w_p, is tilted out of the surface, and an
// upright facet t, of normal w_t, closes the gap: a_p w_p + a_t w_t is the surface's normal. They
// hide each other and exchange light. With the texel's slope s
// (lib/microfacet/slope_distribution.glsl), of angle theta, a_p = 1/cos(theta) and
// a_t = tan(theta), and for a direction u
//   a_p <w_p, u> = u_z - <s, u_xy>,   a_t <w_t, u> = <s, u_xy>, neither below 0.
//
// t is Lambert's, of p's albedo: light that meets t leaves it evenly, so that all orders of
// reflection have a closed form for any reflectance f of p,
//   lambda_p(o) f(i, o) <w_p, i> G_1(i) + Q(i) Q(o) K i_z / pi,
// Q the part of a ray that meets t at once or after p, and K what t sends out of it. This is
// reciprocal if f is, and loses nothing if p does not. The paper's t is a mirror, or of p's own
// material: with the mirror all rays end on p, and a Lambert p looks the same whatever its slope;
// with the material there is no closed form.

// a_p <w_p, u> and a_t <w_t, u>.
vec2 facet_pair_heights(vec2 slope, vec3 direction) {
    float across = dot(slope, direction.xy);
    return max(vec2(direction.z - across, across), 0.0);
}

// lambda_p and lambda_t, Eq. 6: which share of a ray from above the surface each facet takes.
vec2 facet_pair_shares(vec2 slope, vec3 direction) {
    vec2 heights = facet_pair_heights(slope, direction);
    return heights / max(heights.x + heights.y, 1e-20);
}

// G_1, Eq. 8: which part of the light that a facet sends in a direction passes the other.
float facet_pair_masking(vec2 slope, vec3 direction) {
    vec2 heights = facet_pair_heights(slope, direction);
    return clamp(direction.z / max(heights.x + heights.y, 1e-20), 0.0, 1.0);
}

// lambda_p G_1 over <w_p, o>, 0 where p faces away from either: what remains of the factors by
// which facets mask what p's microfacets reflect, F D G_2/(4 <w_p, o>).
float facet_pair_visibility(vec2 slope, vec3 outgoing, vec3 incoming) {
    vec2 seen = facet_pair_heights(slope, outgoing), lit = facet_pair_heights(slope, incoming);
    float area = sqrt(1.0 + dot(slope, slope));
    return seen.x > 0.0 && lit.x > 0.0
               ? area * incoming.z / ((seen.x + seen.y) * (lit.x + lit.y))
               : 0.0;
}

// The same for all the light that a Lambert p sends, or t sends to p, by the crossed strings of
// their profile, a right-angled triangle: (a_p + a_t - 1)/(2 a_p).
float facet_pair_exchange(vec2 slope) {
    float square = dot(slope, slope), area = sqrt(1.0 + square);
    return 0.5 * (sqrt(square) + square / (area + 1.0)) / area;
}

// What p sends to t of the light that its microfacets reflect from one direction, as a mean over
// some of those that the direction sees: Dupuy, Benyoub, 2023, Sampling Visible GGX Normals with
// Spherical Caps. The points are a Fibonacci lattice, which `turn` turns, a part of a circle. With
// 12 of them the error is 0.004 on average over all slopes, directions and roughnesses.
vec3 visible_normal(vec3 direction, float alpha, vec2 point) {
    vec3 stretched = normalize(vec3(alpha * direction.xy, direction.z));
    float height = mix(1.0, -stretched.z, point.x);
    float sine = sqrt(max(1.0 - height * height, 0.0)), angle = 2.0 * PI * point.y;
    vec3 cap = vec3(sine * cos(angle), sine * sin(angle), height) + stretched;
    return normalize(vec3(alpha * cap.xy, cap.z));
}

vec2 lattice_point(int i, int count, float turn) {
    return vec2((float(i) + 0.5) / float(count), fract(0.618033989 * float(i) + turn));
}

// From p's frame: x up the slope, z along its normal.
mat3 facet_frame(vec2 slope) {
    float square = dot(slope, slope), cosine = inversesqrt(1.0 + square);
    vec2 up = square > 0.0 ? slope * inversesqrt(square) : vec2(1.0, 0.0);
    vec3 normal = cosine * vec3(-slope, 1.0);
    vec3 along = cosine * vec3(up, sqrt(square));
    return mat3(along, cross(normal, along), normal);
}

float facet_pair_exchange_of_microfacets(vec2 slope, vec3 direction, float alpha, int count,
                                         float turn) {
    mat3 frame = facet_frame(slope);
    vec3 local = direction * frame;
    if (local.z <= 0.0)
        return 0.0;
    float outgoing = lambda_ggx(local.z, alpha), sum = 0.0, weights = 1e-10;
    // Unrolled: lavapipe leaves loops after 65535 turns in all, and then other lights are left out.
    [[unroll]]
    for (int i = 0; i < count; ++i) {
        vec3 normal = visible_normal(local, alpha, lattice_point(i, count, turn));
        vec3 reflected = 2.0 * dot(local, normal) * normal - local;
        float weight = reflected.z > 0.0
                           ? 1.0 / (1.0 + outgoing + lambda_ggx(reflected.z, alpha))
                           : 0.0;
        sum += weight * (1.0 - facet_pair_masking(slope, frame * reflected));
        weights += weight;
    }
    return sum / weights;
}

// The mean over all directions that light can come from, lambda_p(u) u_z. Fitted to the integral;
// error: at most 0.03.
float facet_pair_mean_exchange_of_microfacets(vec2 slope, float alpha) {
    float square = dot(slope, slope), cosine = inversesqrt(1.0 + square);
    float sine_squared = square / (1.0 + square);
    return facet_pair_exchange(slope) +
           0.5 * max(1.0 - 1.15 * alpha, 0.05) * sine_squared * sqrt(cosine);
}

// K, for facets of this albedo, of which p reflects `returned` back to t (mean of albedo times
// exchange): the albedo over a_t less what t lights itself through p. Of what reaches p from t,
// albedo a_p F, with F its exchange, all but a_p (1 - F) `returned` comes back: reciprocity.
vec3 facet_pair_gain(vec2 slope, vec3 albedo, vec3 returned) {
    float square = dot(slope, slope), area = sqrt(1.0 + square);
    float exchange = facet_pair_exchange(slope);
    vec3 back = area * (albedo * exchange - (1.0 - exchange) * returned);
    return albedo / max(sqrt(square) - albedo * back, 1e-6);
}

#endif
