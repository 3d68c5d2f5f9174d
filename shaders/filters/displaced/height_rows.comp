#version 460
#extension GL_GOOGLE_include_directive : require

// Mean and largest height of each row of a relief, and the mean distance of its facets' normals
// from the pole in the Lambert plane.

#include "filters/displaced/relief_texel.glsl"
#include "interface/displacement/relief.h"
#include "lib/lobe/lambert_plane.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 1, std140) uniform height_field_block { height_field_constants relief; };
layout(set = 0, binding = 2) uniform sampler2D height_map;
layout(set = 0, binding = 3, std430) writeonly buffer row_block { vec4 rows[]; };

float height_at(uint x, uint y) {
    return height_of_texel(texelFetch(height_map, ivec2(x, y), 0).r, relief.scale,
                           relief.least_value, relief.largest_value);
}

float distance_of(float slope_x, float slope_y) {
    return length(plane_from_direction(normalize(vec3(slope_x, slope_y, 1.0))));
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= relief.height)
        return;
    uint above = (row + 1u) % relief.height;
    float sum = 0.0, largest = -HEIGHT_MAXIMUM, distances = 0.0;
    for (uint i = 0u; i < relief.width; ++i) {
        uint next = (i + 1u) % relief.width;
        float height = height_at(i, row), along = height_at(next, row), up = height_at(i, above),
              across = height_at(next, above);
        sum += height;
        largest = max(largest, height);
        distances += distance_of(along - height, across - along) +
                     distance_of(across - up, up - height);
    }
    float scale = 1.0 / float(relief.width);
    rows[row] = vec4(scale * sum, largest, 0.5 * scale * distances, 0.0);
}
