#ifndef FACETS_GLSL
#define FACETS_GLSL

// Facets by number within a window (interface/displacement/relief.h): two for each quad, the upper
// one second.

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

ivec2 window_origin() {
    return ivec2(transfer.origin_x, transfer.origin_y);
}

// In the relief's first period.
ivec2 quad_of(uint quad) {
    return first_period(window_origin() +
                        ivec2(quad % transfer.width, quad / transfer.width));
}

facet facet_of(uint index) {
    facet result;
    result.quad = quad_of(index / 2u);
    result.upper = (index & 1u) != 0u;
    vec4 corners = quad_heights(result.quad);
    result.slope = facet_slope(corners, result.upper);
    result.normal = facet_normal(result.slope);
    vec2 inside = result.upper ? vec2(1.0, 2.0) / 3.0 : vec2(2.0, 1.0) / 3.0;
    result.centre = vec3(vec2(result.quad) + inside, corners.x + dot(result.slope, inside));
    return result;
}

uint facet_index(ivec2 quad, bool upper) {
    uvec2 inside = uvec2(first_period(quad - window_origin())) %
                   uvec2(transfer.width, transfer.height);
    return 2u * (inside.y * transfer.width + inside.x) + (upper ? 1u : 0u);
}

#endif
