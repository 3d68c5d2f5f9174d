#version 460
#extension GL_GOOGLE_include_directive : require

// The points of a welded mesh in its pose: where they are, and which way they are displaced. That
// is the mean of the normals of all corners there, weighted by the angles of their triangles, which
// does not depend on how faces are cut into triangles (Thürmer, Wüthrich 1998, Computing Vertex
// Normals from Polygonal Facets). At hard edges it is between the normals of both faces.

#include "displacement/corner_angle.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 5, std430) writeonly buffer point_block { posed_point points[]; };

vec3 vertex_normal(uint index) {
    return vec3(vertices[index].normal[0], vertices[index].normal[1], vertices[index].normal[2]);
}

vec3 direction_of(base_point point, vec3 otherwise) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < point.corner_count; ++i) {
        uvec3 corner = vertices_from(corners[point.first_corner + i]);
        vec3 origin = vertex_position(corner.x);
        float angle = angle_between(vertex_position(corner.y) - origin,
                                    vertex_position(corner.z) - origin);
        sum += angle * normalize(vertex_normal(corner.x));
    }
    // Sheets whose two sides cancel.
    return dot(sum, sum) > 1e-8 ? normalize(sum) : otherwise;
}

void main() {
    uint number = thread_number();
    if (number >= constants.count)
        return;
    base_point point = base_points[number];
    uint vertex = charts[point.first_chart].vertex;
    vec3 position = vertex_position(vertex);
    vec3 direction = direction_of(point, normalize(vertex_normal(vertex)));
    for (int i = 0; i < 3; ++i) {
        points[number].position[i] = position[i];
        points[number].direction[i] = direction[i];
    }
}
