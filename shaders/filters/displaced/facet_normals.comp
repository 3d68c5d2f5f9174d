#version 460
#extension GL_GOOGLE_include_directive : require

// The first level of the map of facets' normals (interface/displacement/relief.h): means over the
// facets under each texel, of half the size of the relief; all within a window. A thread a texel.

#include "filters/displaced/facets.glsl"
#include "filters/displaced/facet_words.glsl"
#include "lib/displacement/facet_bins.glsl"
#include "lib/displacement/facet_points.glsl"
#include "lib/displacement/facets_under_texel.glsl"
#include "lib/displacement/transfer_basis.glsl"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/map/base_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 5, std430) readonly buffer basis_block {
    transfer_basis_constants basis;
};
layout(set = 0, binding = 8) uniform writeonly image2DArray facet_map;
layout(set = 0, binding = 9) uniform sampler2D width_map;

layout(constant_id = SPECIALISE_TRANSFER_WIDTHS) const bool WIDTHS = false;

const uint LAYERS = (WIDTHS ? 3u : 2u) * FACET_BINS;

vec4 groups[2 * FACET_BINS];
vec4 layers[3 * FACET_BINS];

// Of the map's roughness.
float mean_square_roughness(facet here) {
    vec2 size = vec2(relief_size());
    uint points = facet_points(textureSize(width_map, 0), relief_size());
    float sum = 0.0;
    for (uint i = 0u; i < points * points; ++i) {
        vec2 inside = point_in_facet(i, points, here.upper);
        float roughness =
            clamp(base_texel(width_map, (vec2(here.quad) + 0.5 + inside) / size).g, 0.0, 1.0);
        sum += roughness * roughness;
    }
    return sum / float(points * points);
}

float expected_hidden(vec3 normal) {
    float sum = 0.0;
    for (uint i = 0u; i < FACET_DIRECTIONS; ++i)
        sum += basis.hidden[i / 4u][i % 4u] * max(dot(normal, facet_direction(i)), 0.0);
    return sum;
}

void add_facet(uint index, float weight) {
    // The relief's y runs against the tangent frame's.
    facet here = facet_of(index);
    vec3 normal = vec3(1.0, -1.0, 1.0) * here.normal;
    float area = weight / normal.z, parts[FACET_BINS];
    vec2 place = plane_from_direction(normal);
    // The first polynomial is the cosine to the carrier.
    float hidden = product_of_cosines(normal.z) - TRANSFER_COSINE * facet_coefficient(index, 0u);
    float expected = expected_hidden(normal);
    float alpha = WIDTHS ? mean_square_roughness(here) : 0.0;
    facet_parts(place, groups, parts);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        vec2 d = place - groups[2u * k].xy;
        vec4 own = parts[k] * area * vec4(1.0, d, max(hidden, 0.0));
        layers[2u * k] += own;
        layers[2u * k + 1u] += parts[k] * area * vec4(d * d, d.x * d.y, expected);
        if (WIDTHS)
            layers[2u * FACET_BINS + k] += alpha * own;
    }
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy + uvec2(transfer.first_column, transfer.first_row);
    uvec2 target = texel - uvec2(transfer.target_column, transfer.target_row);
    if (any(greaterThanEqual(target, uvec2(imageSize(facet_map).xy))))
        return;
    for (uint i = 0u; i < LAYERS; ++i)
        layers[i] = vec4(0.0);
    groups = basis.groups;
    add_facets_under(texel, relief_size());
    for (uint i = 0u; i < LAYERS; ++i)
        imageStore(facet_map, ivec3(target, i), layers[i]);
}
