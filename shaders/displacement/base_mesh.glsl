#ifndef BASE_MESH_GLSL
#define BASE_MESH_GLSL

// Places on a base mesh. All triangles that share a point or an edge find the same place there from
// the same numbers, in the same order: what is computed from a place is equal to the bit.

#include "displacement/displaced_surface.glsl"

layout(set = 0, binding = 1, std430) readonly buffer triangle_block { base_triangle triangles[]; };
layout(set = 0, binding = 2, std430) readonly buffer edge_block { base_edge edges[]; };
layout(set = 0, binding = 3, std430) readonly buffer chart_block { base_chart charts[]; };
layout(set = 0, binding = 4, std430) readonly buffer point_block { posed_point points[]; };

#define SITE_POINT    0u
#define SITE_EDGE     1u
#define SITE_TRIANGLE 2u

// The smallest part of the mesh with a place in it.
struct base_site {
    uint kind, index; // SITE_..., which point, edge or triangle
    float part;       // of an edge, from its first end to its second
    vec3 weights;     // of a triangle's corners
};

uint point_of_corner(uint triangle, int corner) {
    return charts[triangles[triangle].charts[corner]].point;
}

base_site site_on_edge(base_place place, int first, int second) {
    uint edge = triangles[place.triangle].edges[first];
    int end = point_of_corner(place.triangle, second) == edges[edge].points[1] ? second : first;
    return base_site(SITE_EDGE, edge, float(place.weights[end]) / float(place_weight()),
                     vec3(0.0));
}

base_site site_of(base_place place) {
    ivec3 w = place.weights;
    int all = place_weight();
    int corner = w.x == all ? 0 : w.y == all ? 1 : w.z == all ? 2 : -1;
    int edge = w.z == 0 ? 0 : w.x == 0 ? 1 : w.y == 0 ? 2 : -1;
    if (corner >= 0)
        return base_site(SITE_POINT, point_of_corner(place.triangle, corner), 0.0, vec3(0.0));
    if (edge >= 0)
        return site_on_edge(place, edge, (edge + 1) % 3);
    return base_site(SITE_TRIANGLE, place.triangle, 0.0, vec3(w) / float(all));
}

vec3 point_position(uint point) {
    return vec3(points[point].position[0], points[point].position[1], points[point].position[2]);
}

vec3 site_position(base_site site) {
    precise vec3 result;
    if (site.kind == SITE_POINT) {
        result = point_position(site.index);
    } else if (site.kind == SITE_EDGE) {
        vec3 first = point_position(edges[site.index].points[0]);
        result = first + site.part * (point_position(edges[site.index].points[1]) - first);
    } else {
        result = site.weights.x * point_position(point_of_corner(site.index, 0)) +
                 site.weights.y * point_position(point_of_corner(site.index, 1)) +
                 site.weights.z * point_position(point_of_corner(site.index, 2));
    }
    return result;
}

#endif
