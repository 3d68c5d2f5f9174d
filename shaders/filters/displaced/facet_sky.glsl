#ifndef FACET_SKY_GLSL
#define FACET_SKY_GLSL

// What the facets of a quad see of the sky, by the horizon of its middle in each azimuth.

#include "filters/displaced/facets.glsl"
#include "filters/displaced/horizon.glsl"
#include "lib/displacement/transfer_basis.glsl"

// What raises a horizon by less, as a slope, is not looked for.
const float LEAST_RISE = 0.02;

// The tangent of the elevation above which a facet's own plane leaves the sky free.
float own_horizon(vec3 normal, vec2 along) {
    return max(-dot(normal.xy, along) / normal.z, 0.0);
}

// Of both facets of a quad: the coefficients, in all polynomials, of the cosine of the normal where
// the sky is seen.
void see_sky(uint quad, out float lower[16], out float upper[16]) {
    vec3 lower_normal = facet_of(2u * quad).normal, upper_normal = facet_of(2u * quad + 1u).normal;
    ivec2 place = quad_of(quad);
    vec4 corners = quad_heights(place);
    vec3 middle = vec3(vec2(place) + 0.5, 0.5 * (corners.x + corners.w));
    for (int k = 0; k < 16; ++k)
        lower[k] = upper[k] = 0.0;
    float width = 2.0 * PI / float(transfer.azimuths);
    float period = float(max(relief.width, relief.height));
    for (uint i = 0u; i < transfer.azimuths; ++i) {
        float azimuth = (float(i) + 0.5) * width;
        vec2 along = vec2(cos(azimuth), sin(azimuth));
        float of_lower = own_horizon(lower_normal, along),
              of_upper = own_horizon(upper_normal, along);
        float slope = horizon(middle, along, 1.0, LEAST_RISE, period, min(of_lower, of_upper));
        // The polynomials are those of the tangent frame.
        vec2 tangent = vec2(along.x, -along.y);
        add_polynomials_of_azimuth(max(slope, of_lower), tangent, dot(lower_normal.xy, along),
                                   lower_normal.z, width, lower);
        add_polynomials_of_azimuth(max(slope, of_upper), tangent, dot(upper_normal.xy, along),
                                   upper_normal.z, width, upper);
    }
}

#endif
