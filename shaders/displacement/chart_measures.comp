#version 460
#extension GL_GOOGLE_include_directive : require

// The lengths over which u and v of the height map grow by 1, in the object's lengths: |S_u| and
// |S_v| of its triangles, from [e1 e2] [duv1 duv2]^-1, weighted by their angles at the chart.
// Lengths, not vectors: where texture coordinates are mirrored, those of both sides would cancel.
// Triangles whose coordinates have no area have none. And the texels along the longest of their
// edges.

#include "displacement/corner_angle.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 5, std430) writeonly buffer measure_block { chart_measure measures[]; };

vec2 coordinates(uint index) {
    uint first = 2u * constants.second_set;
    vec3 set = vec3(vertices[index].texture_coordinates[first],
                    vertices[index].texture_coordinates[first + 1u], 1.0);
    return vec2(dot(constants.map_rows[0].xyz, set), dot(constants.map_rows[1].xyz, set));
}

float texels_along(vec2 difference) {
    return length(difference * vec2(constants.width, constants.height));
}

bool is_chart(uint vertex, uint chart) {
    uint like = charts[chart].vertex;
    for (int i = 0; i < 4; ++i)
        if (vertices[vertex].texture_coordinates[i] != vertices[like].texture_coordinates[i])
            return false;
    return true;
}

void main() {
    uint number = thread_number();
    if (number >= constants.count)
        return;
    base_point point = base_points[charts[number].point];
    vec2 sum = vec2(0.0);
    float weights = 0.0, edge = 0.0;
    for (uint i = 0u; i < point.corner_count; ++i) {
        uvec3 corner = vertices_from(corners[point.first_corner + i]);
        if (!is_chart(corner.x, number))
            continue;
        vec3 origin = vertex_position(corner.x);
        vec3 first = vertex_position(corner.y) - origin;
        vec3 second = vertex_position(corner.z) - origin;
        vec2 start = coordinates(corner.x);
        vec2 du = coordinates(corner.y) - start, dv = coordinates(corner.z) - start;
        edge = max(edge, max(texels_along(du - dv), max(texels_along(du), texels_along(dv))));
        float size = max(max(abs(du.x), abs(du.y)), max(abs(dv.x), abs(dv.y)));
        float area = size > 0.0 ? du.x / size * (dv.y / size) - du.y / size * (dv.x / size) : 0.0;
        if (abs(area) < 1e-7)
            continue;
        float scale = max(max(largest_element(first), largest_element(second)), 1e-37);
        vec3 along_u = (first / scale * dv.y - second / scale * du.y) / size;
        vec3 along_v = (second / scale * du.x - first / scale * dv.x) / size;
        float angle = angle_between(first, second);
        sum += angle * (scale / size) / abs(area) * vec2(length(along_u), length(along_v));
        weights += angle;
    }
    vec2 lengths = weights > 0.0 ? sum / weights : vec2(0.0);
    measures[number] = chart_measure(float[2](lengths.x, lengths.y), edge);
}
