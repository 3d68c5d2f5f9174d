#version 460
#extension GL_GOOGLE_include_directive : require

// What each facet sees of the sky: the coefficients b (interface/displacement/relief.h), by the
// horizon of the middle of its quad in each azimuth. One thread a quad.

#include "filters/displaced/facets.glsl"
#include "lib/displacement/transfer_basis.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) writeonly buffer transfer_words { uint words[]; };

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

void store(uint index, float b[9]) {
    for (int k = 0; k < TRANSFER_WORDS; ++k)
        words[index * TRANSFER_WORDS + k] =
            packHalf2x16(vec2(b[2 * k], 2 * k + 1 < 9 ? b[min(2 * k + 1, 8)] : 0.0));
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (2u * index >= facet_count())
        return;
    vec3 lower = facet_of(2u * index).normal, upper = facet_of(2u * index + 1u).normal;
    ivec2 quad = ivec2(index % transfer.width, index / transfer.width);
    vec4 corners = quad_heights(quad);
    vec3 middle = vec3(vec2(quad) + 0.5, 0.5 * (corners.x + corners.w));
    float b_lower[9], b_upper[9];
    for (int k = 0; k < 9; ++k)
        b_lower[k] = b_upper[k] = 0.0;
    float width = 2.0 * PI / float(transfer.azimuths);
    for (uint i = 0u; i < transfer.azimuths; ++i) {
        float azimuth = (float(i) + 0.5) * width;
        vec2 along = vec2(cos(azimuth), sin(azimuth));
        float of_lower = own_horizon(lower, along), of_upper = own_horizon(upper, along);
        float slope = horizon(middle, along, min(of_lower, of_upper));
        // The functions are those of the tangent frame.
        vec2 tangent = vec2(along.x, -along.y);
        add_transfer_of_azimuth(max(slope, of_lower), tangent, dot(lower.xy, along), lower.z, width,
                                b_lower);
        add_transfer_of_azimuth(max(slope, of_upper), tangent, dot(upper.xy, along), upper.z, width,
                                b_upper);
    }
    store(2u * index, b_lower);
    store(2u * index + 1u, b_upper);
}
