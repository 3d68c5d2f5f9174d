#version 460
#extension GL_GOOGLE_include_directive : require

// The first level of the map of facets' normals (interface/displacement/relief.h): means over the
// facets under each texel, of half the size of the relief; all within a window. A thread a texel.

#include "filters/displaced/facets.glsl"
#include "lib/displacement/facet_bins.glsl"
#include "lib/lobe/lambert_plane.glsl"
#include "lib/map/box_reduction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 8) uniform writeonly image2DArray facet_map;

vec4 layers[2 * FACET_BINS];

void add_facet(uint index, float weight) {
    vec3 normal = facet_of(index).normal;
    float area = weight / normal.z, radius = height_extent.z;
    // The relief's y runs against the tangent frame's.
    vec2 place = plane_from_direction(vec3(normal.x, -normal.y, normal.z));
    uint bin = facet_bin_of(place, radius);
    vec2 d = place - facet_bin_centre(bin, radius);
    layers[2u * bin] += area * vec4(1.0, d, 0.0);
    layers[2u * bin + 1u] += area * vec4(d * d, d.x * d.y, 0.0);
}

void main() {
    uvec2 texel = gl_GlobalInvocationID.xy + uvec2(transfer.first_column, transfer.first_row);
    uvec2 target = texel - uvec2(transfer.target_column, transfer.target_row);
    if (any(greaterThanEqual(target, uvec2(imageSize(facet_map).xy))))
        return;
    for (uint i = 0u; i < 2u * FACET_BINS; ++i)
        layers[i] = vec4(0.0);
    ivec2 size = relief_size();
    vec3 columns = box_weights(size.x, int(texel.x)), rows = box_weights(size.y, int(texel.y));
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x) {
            uint lower = facet_index(2 * ivec2(texel) + ivec2(x, y), false);
            add_facet(lower, 0.5 * columns[x] * rows[y]);
            add_facet(lower + 1u, 0.5 * columns[x] * rows[y]);
        }
    }
    for (uint i = 0u; i < 2u * FACET_BINS; ++i)
        imageStore(facet_map, ivec3(target, i), layers[i]);
}
