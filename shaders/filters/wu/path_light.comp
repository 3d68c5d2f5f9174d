#version 460
#extension GL_GOOGLE_include_directive : require

// What the vertices of a path get from each direction of the table, as cosines: the first vertex,
// the second, and all but the first. The first and the last are times the square root of the first
// facet's area, so that products of two are weighted with the area. A thread for each path and
// direction.

#include "filters/displaced/height_field.glsl"
#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) readonly buffer vertex_block { path_point points[]; };
layout(set = 0, binding = 5, std430) writeonly buffer first_block { float first[]; };
layout(set = 0, binding = 6, std430) writeonly buffer second_block { float second[]; };
layout(set = 0, binding = 7, std430) writeonly buffer later_block { float later[]; };

// Directions that fill up the table send nothing.
float light_at(path_point point, vec3 direction) {
    float cosine = dot(point.normal.xyz, direction);
    return cosine > 0.0 && sees_sky(point.position.xyz, direction) ? cosine : 0.0;
}

void main() {
    uint directions = filled_direction_count();
    uint index = gl_GlobalInvocationID.x / directions, which = gl_GlobalInvocationID.x % directions;
    if (index >= path_count())
        return;
    vec3 direction =
        which < direction_count() ? direction_of_index(which, wu.angular) : vec3(0.0);
    path_point start = points[index * wu.bounces];
    float root = inversesqrt(start.normal.z), next = 0.0, sum = 0.0;
    first[gl_GlobalInvocationID.x] = root * light_at(start, direction);
    for (uint k = 1u; k < wu.bounces; ++k) {
        path_point point = points[index * wu.bounces + k];
        if (point.position.w == 0.0)
            break;
        float light = light_at(point, direction);
        next = k == 1u ? light : next;
        sum += light;
    }
    second[gl_GlobalInvocationID.x] = next;
    later[gl_GlobalInvocationID.x] = root * sum;
}
