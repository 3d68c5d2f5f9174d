#ifndef FACETS_GLSL
#define FACETS_GLSL

// Facets by number: two for each quad, the upper one second.

#include "filters/displaced/height_field.glsl"

layout(push_constant) uniform transfer_block { transfer_constants transfer; };

struct facet {
    vec3 centre; // on the relief
    vec3 normal;
    vec2 slope;
    ivec2 quad;
    bool upper;
};

uint facet_count() {
    return 2u * transfer.width * transfer.height;
}

facet facet_of(uint index) {
    facet result;
    uint quad = index / 2u;
    result.quad = ivec2(quad % transfer.width, quad / transfer.width);
    result.upper = (index & 1u) != 0u;
    vec4 corners = quad_heights(result.quad);
    result.slope = facet_slope(corners, result.upper);
    result.normal = facet_normal(result.slope);
    vec2 inside = result.upper ? vec2(1.0, 2.0) / 3.0 : vec2(2.0, 1.0) / 3.0;
    result.centre = vec3(vec2(result.quad) + inside, corners.x + dot(result.slope, inside));
    return result;
}

uint facet_index(ivec2 quad, bool upper) {
    return 2u * (uint(quad.y) * transfer.width + uint(quad.x)) + (upper ? 1u : 0u);
}

#endif
