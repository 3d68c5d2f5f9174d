#ifndef WU_PATHS_GLSL
#define WU_PATHS_GLSL

// Where paths of light start, and what is kept of them. Needs wu/cells.glsl.

#include "filters/wu/directions.glsl"
#include "lib/number/hash.glsl"

// A vertex of a path.
struct path_point {
    vec4 position; // w: 0: the path has left the relief
    vec4 normal;
};

// Directions of the table, and with those that fill up the last eight of a sample.
uint direction_count() {
    return wu.angular * wu.angular;
}

uint filled_direction_count() {
    return (direction_count() + 7u) & ~7u;
}

// Of the table; beyond it, its last one.
vec3 direction_at(uint index) {
    return direction_of_index(min(index, direction_count() - 1u), wu.angular);
}

uint path_count() {
    return wu.patches * wu.patches * wu.points;
}

// Paths of a patch follow each other. In a patch they start near the points of a lattice of
// rank 1, by the golden ratio.
vec2 path_start(uint index) {
    uint patch_index = index / wu.points, i = index % wu.points;
    vec2 corner = vec2(patch_index % wu.patches, patch_index / wu.patches);
    vec2 inside = vec2((float(i) + hashed_number(2u * index)) / float(wu.points),
                       fract(0.618033989 * float(i) + hashed_number(2u * patch_index + 1u)));
    return (corner + inside) * vec2(wu.width, wu.height) / float(wu.patches);
}

// How deep a sample lies in its facet of a coarse relief: the part of this that is higher. Two
// directions see it, if both see more than this part.
float depth_in_facet(uint sample_index) {
    return hashed_number(hash(sample_index) + 3u);
}

#endif
