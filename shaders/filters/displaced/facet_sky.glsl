#ifndef FACET_SKY_GLSL
#define FACET_SKY_GLSL

// What the facets of a quad see of the sky, by the horizon of its middle in each azimuth.

#include "filters/displaced/facets.glsl"
#include "lib/displacement/transfer_basis.glsl"

// What raises a horizon by less, as a slope, is not looked for, nor what is more than a period
// away.
const float LEAST_RISE = 0.02;

// Raises a horizon by one vertex of the line that the walk crosses.
void raise(inout float slope, relief_walk walk, vec4 corners, bool upper, float place) {
    vec2 inside = walk.origin.xy - vec2(walk.quad) + place * walk.direction.xy;
    float height = corners.x + dot(facet_slope(corners, upper), inside);
    if (place > 1e-4)
        slope = max(slope, (height - walk.origin.z) / place);
}

void raise_by_quad(inout float slope, relief_walk walk) {
    vec4 corners = quad_heights(walk.quad);
    float crossing = crossing_of_diagonal(walk);
    bool first = is_upper(walk, 0.5 * (walk.place + crossing));
    raise(slope, walk, corners, first, crossing);
    raise(slope, walk, corners, is_upper(walk, 0.5 * (crossing + walk.leave)), walk.leave);
}

// The tangent of the elevation above which the sky is seen in a horizontal direction, if that is
// more than `slope`.
float horizon(vec3 origin, vec2 along, float slope) {
    relief_walk walk = start_walk(origin, vec3(along, 0.0));
    float rise = largest_height() - origin.z, period = float(max(relief.width, relief.height));
    for (int i = 0; i < WALK_STEPS; ++i) {
        float least = (slope + LEAST_RISE) * walk.place;
        if (rise <= least || walk.place > period)
            break;
        if (walk.level > 0 && node_maximum(walk) - origin.z > least) {
            descend(walk);
            continue;
        }
        if (walk.level == 0)
            raise_by_quad(slope, walk);
        advance(walk);
    }
    return slope;
}

// The same of a facet's own plane.
float own_horizon(vec3 normal, vec2 along) {
    return max(-dot(normal.xy, along) / normal.z, 0.0);
}

// Of both facets of a quad: the coefficients, in all polynomials, of the cosine of the normal where
// the sky is seen.
void see_sky(uint quad, out float lower[16], out float upper[16]) {
    vec3 lower_normal = facet_of(2u * quad).normal, upper_normal = facet_of(2u * quad + 1u).normal;
    ivec2 place = ivec2(quad % transfer.width, quad / transfer.width);
    vec4 corners = quad_heights(place);
    vec3 middle = vec3(vec2(place) + 0.5, 0.5 * (corners.x + corners.w));
    for (int k = 0; k < 16; ++k)
        lower[k] = upper[k] = 0.0;
    float width = 2.0 * PI / float(transfer.azimuths);
    for (uint i = 0u; i < transfer.azimuths; ++i) {
        float azimuth = (float(i) + 0.5) * width;
        vec2 along = vec2(cos(azimuth), sin(azimuth));
        float of_lower = own_horizon(lower_normal, along),
              of_upper = own_horizon(upper_normal, along);
        float slope = horizon(middle, along, min(of_lower, of_upper));
        // The polynomials are those of the tangent frame.
        vec2 tangent = vec2(along.x, -along.y);
        add_polynomials_of_azimuth(max(slope, of_lower), tangent, dot(lower_normal.xy, along),
                                   lower_normal.z, width, lower);
        add_polynomials_of_azimuth(max(slope, of_upper), tangent, dot(upper_normal.xy, along),
                                   upper_normal.z, width, upper);
    }
}

#endif
