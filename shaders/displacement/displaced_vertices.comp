#version 460
#extension GL_GOOGLE_include_directive : require

// The vertices of a displaced surface, a thread for each: a grid in each patch, with as many
// segments as the patch's longest edge has. On shorter edges several vertices share a place, and
// the triangles between them have no area: both patches of an edge have the same vertices there.
//
// When the camera comes closer, the number of segments doubles, and vertices with odd numbers
// appear: inside of a patch halfway between their neighbours, on an edge at the place of the one
// before. From there they slide to their own places, until the number doubles again. At each moment
// the new triangles cover the old ones, so that a surface is a function of the camera without a
// jump.

#include "displacement/height_map.glsl"
#include "displacement/patch_search.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 14, std430) readonly buffer index_block { uint indices[]; };
layout(set = 0, binding = 15, std430) writeonly buffer displaced_block { vertex displaced[]; };

// ---------------------------------------------------------------------------------------------
// Positions

// Between vertices, over what was asked for.
float spacing_factor() {
    return exp2(min(chosen_spacing(), float(PATCH_WIDEST)));
}

// Metres between vertices.
float vertex_distance(base_site site) {
    return constants.spacing * spacing_factor() / pixels_per_metre_at(site);
}

vec3 displaced_place(base_place place) {
    base_site site = site_of(place);
    vec3 position = site_position(site);
    precise vec3 result = position + constants.relief *
                                         site_height(site, vertex_distance(site)) *
                                         site_direction(site);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Vertices of a patch

struct patch_grid {
    base_patch parts;
    vec4 sizes; // of edges, from each corner to the next; then the largest
    int segments;
};

ivec3 unit_weight(int corner) {
    return ivec3(corner == 0, corner == 1, corner == 2);
}

// Weights, of sum `segments`, of a point of the edge that begins at a corner.
ivec3 edge_weights(int edge, int number, int segments) {
    return (segments - number) * unit_weight(edge) + number * unit_weight((edge + 1) % 3);
}

// The edge on which a vertex of the grid lies; -1: none.
int edge_with(ivec3 weights) {
    return weights.z == 0 ? 0 : weights.x == 0 ? 1 : weights.y == 0 ? 2 : -1;
}

// Whether an edge of a patch begins, for both of its patches, at the patch's corner `edge`.
bool begins_at(base_patch parts, int edge) {
    ivec3 first = parts.corners[edge], second = parts.corners[(edge + 1) % 3];
    int along = first.z == 0 && second.z == 0   ? 0
                : first.x == 0 && second.x == 0 ? 1
                : first.y == 0 && second.y == 0 ? 2
                                                : -1;
    if (along < 0) // inside of the mesh's triangle
        return first.x != second.x ? first.x < second.x : first.y < second.y;
    uint whole = triangles[parts.triangle].edges[along];
    int next = (along + 1) % 3;
    int end = point_of_corner(parts.triangle, next) == edges[whole].points[1] ? next : along;
    return first[end] < second[end];
}

// Where a vertex of the grid is: weights, of sum `segments`, of the patch's corners. On an edge it
// shares the place of one of the edge's points.
struct grid_point {
    ivec3 weights;
    int segments;
    float grown; // how far it has come to there
    ivec3 start; // from where, on an edge
};

grid_point point_of_edge(patch_grid grid, int edge, ivec3 weights) {
    int segments = segments_of(grid.sizes[edge]), step = grid.segments / segments;
    bool forwards = begins_at(grid.parts, edge);
    int number = weights[forwards ? (edge + 1) % 3 : edge] / step, before = max(number - 1, 0);
    grid_point result;
    result.segments = segments;
    result.weights = edge_weights(edge, forwards ? number : segments - number, segments);
    result.start = edge_weights(edge, forwards ? before : segments - before, segments);
    result.grown = segments_grown(grid.sizes[edge]);
    return result;
}

grid_point point_of_grid(patch_grid grid, ivec3 weights) {
    int edge = edge_with(weights);
    grid_point result =
        grid_point(weights, grid.segments, segments_grown(grid.sizes.w), weights);
    if (edge >= 0)
        result = point_of_edge(grid, edge, weights);
    if (result.segments == 1 || all(equal(result.weights % 2, ivec3(0))))
        result.grown = 1.0;
    return result;
}

// From one neighbour with even numbers to the other.
ivec3 odd_direction(ivec3 weights) {
    ivec3 odd = weights % 2;
    return odd.x == 0 ? ivec3(0, 1, -1) : odd.y == 0 ? ivec3(1, 0, -1) : ivec3(1, -1, 0);
}

// What belongs to a vertex on its way.
vec3 slid(vec3 start, vec3 own, float grown) {
    precise vec3 result = start + grown * (own - start);
    return grown < 1.0 ? result : own;
}

// The position of a vertex, and the weights of the triangle's corners from which all its other
// attributes are interpolated; they add up to 1. Both move together.
struct moving_vertex {
    vec3 position, weights;
};

moving_vertex vertex_at(patch_grid grid, ivec3 weights, int segments) {
    base_place place = place_in_patch(grid.parts, weights, segments);
    return moving_vertex(displaced_place(place), vec3(place.weights) / float(place_weight()));
}

moving_vertex slid_vertex(moving_vertex start, moving_vertex own, float grown) {
    return moving_vertex(slid(start.position, own.position, grown),
                         slid(start.weights, own.weights, grown));
}

// Neighbours of a vertex inside may be on their way along an edge: one loop over the starts and the
// places of the vertex itself and of both neighbours, so that the code for a place exists once.
moving_vertex vertex_of_grid(patch_grid grid, ivec3 weights) {
    bool inside = edge_with(weights) < 0;
    moving_vertex start = moving_vertex(vec3(0.0), vec3(0.0)), own = start, neighbours = start;
    float grown = 1.0;
    for (int i = 0; i < (inside && grown < 1.0 ? 6 : 2); ++i) {
        ivec3 place = weights;
        if (i >= 2)
            place += (i < 4 ? -1 : 1) * odd_direction(weights);
        grid_point point = point_of_grid(grid, place);
        grown = i == 0 ? point.grown : grown;
        bool slides = edge_with(place) >= 0 && point.grown < 1.0, is_start = i % 2 == 0;
        if (is_start && !slides)
            continue;
        moving_vertex found =
            vertex_at(grid, is_start ? point.start : point.weights, point.segments);
        if (is_start) {
            start = found;
            continue;
        }
        found = slid_vertex(start, found, slides ? point.grown : 1.0);
        if (i == 1)
            own = found;
        else
            neighbours = moving_vertex(neighbours.position + found.position,
                                       neighbours.weights + found.weights);
    }
    moving_vertex middle = moving_vertex(0.5 * neighbours.position, 0.5 * neighbours.weights);
    return slid_vertex(middle, own, inside ? grown : 1.0);
}

// With two segments, the middles of the smaller edges may still be at the ends of the largest one:
// if the vertex in the middle were half-way between them, a wall would stand before the middle of
// that edge. It lies below that and the opposite corner then, and comes to its place as the smaller
// edges grow, and before there are more segments.
float middle_grown(vec4 sizes) {
    float least = min(min(sizes.x, sizes.y), sizes.z);
    float second = clamp(sizes.x + sizes.y + sizes.z - least - sizes.w, 0.0, 1.0);
    return 1.0 - (1.0 - second / sizes.w) * (1.0 - sizes.w * sizes.w);
}

// How much of the vertex in the middle is each of the four around it.
float middle_part(vec4 sizes, int number) {
    float grown = middle_grown(sizes);
    return 0.5 * (number % 2 == 0 ? 1.0 - grown : grown);
}

moving_vertex vertex_of_patch(patch_grid grid, uint number) {
    bool in_middle = grid.segments == 2 && number + 1u == counts_of(2).x;
    ivec2 place = lattice_row_of(number);
    moving_vertex sum = moving_vertex(vec3(0.0), vec3(0.0));
    for (int i = 0; i < (in_middle ? 4 : 1); ++i) {
        ivec3 weights = in_middle ? point_around(grid.sizes, int[4](1, 3, 4, 5)[i])
                                  : lattice_point(grid.segments, place.x, place.y);
        moving_vertex found = vertex_of_grid(grid, weights);
        if (!in_middle)
            return found;
        float part = middle_part(grid.sizes, i);
        sum = moving_vertex(sum.position + part * found.position,
                            sum.weights + part * found.weights);
    }
    return sum;
}

// ---------------------------------------------------------------------------------------------
// What else a vertex has: that of the base mesh

vec3 normal_of(uint index) {
    return vec3(vertices[index].normal[0], vertices[index].normal[1], vertices[index].normal[2]);
}

vertex base_vertex(uint triangle, vec3 weights) {
    uvec3 corner = uvec3(indices[3u * triangle], indices[3u * triangle + 1u],
                         indices[3u * triangle + 2u]);
    vec3 normal = weights.x * normal_of(corner.x) + weights.y * normal_of(corner.y) +
                  weights.z * normal_of(corner.z);
    normal = dot(normal, normal) > 1e-8 ? normal : normal_of(corner.x);
    vertex result;
    for (int i = 0; i < 3; ++i)
        result.normal[i] = normal[i];
    for (int i = 0; i < 4; ++i) {
        result.tangent[i] = weights.x * vertices[corner.x].tangent[i] +
                            weights.y * vertices[corner.y].tangent[i] +
                            weights.z * vertices[corner.z].tangent[i];
        result.texture_coordinates[i] = weights.x * vertices[corner.x].texture_coordinates[i] +
                                        weights.y * vertices[corner.y].texture_coordinates[i] +
                                        weights.z * vertices[corner.z].texture_coordinates[i];
        result.colour[i] = weights.x * vertices[corner.x].colour[i] +
                           weights.y * vertices[corner.y].colour[i] +
                           weights.z * vertices[corner.z].colour[i];
    }
    return result;
}

void main() {
    uint number = thread_number();
    if (number >= arguments[PATCH_TOTALS])
        return;
    if (number == 0u)
        displaced[0].position[0] = spacing_factor();
    uint found = patch_with(number, 0);
    vec4 sizes = sizes_of_patch(found);
    patch_grid grid = patch_grid(patch_of(found), sizes, segments_of(sizes.w));
    moving_vertex moving = vertex_of_patch(grid, number - offsets[found].x);
    vertex result = base_vertex(grid.parts.triangle, moving.weights);
    for (int i = 0; i < 3; ++i)
        result.position[i] = moving.position[i];
    displaced[number + PATCH_FIRST_VERTEX] = result;
}
