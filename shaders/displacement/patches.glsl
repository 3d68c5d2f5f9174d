#ifndef PATCHES_GLSL
#define PATCHES_GLSL

// Patches: triangles of a lattice over each triangle of the base mesh. Rows are counted from corner
// 0; row r of triangles has one that points towards that corner, then one that points away, and so
// on. The grid inside a patch is a lattice of the same kind.

#include "displacement/displaced_surface.glsl"

struct base_patch {
    uint triangle;
    ivec3 corners[3]; // weights of the triangle's corners, which add up to 2^depth
};

// floor(sqrt(n)).
int root_of(uint n) {
    int root = int(sqrt(float(n)));
    root -= uint(root * root) > n ? 1 : 0;
    return root + (uint((root + 1) * (root + 1)) <= n ? 1 : 0);
}

// Weights, of sum `rows`, of a lattice's point.
ivec3 lattice_point(int rows, int row, int column) {
    return ivec3(rows - row, row - column, column);
}

// The corners of a triangle of a lattice.
void lattice_triangle(int rows, uint number, out ivec3 corners[3]) {
    int row = root_of(number), column = int(number) - row * row, first = column / 2;
    bool inverted = column % 2 != 0;
    corners[0] = lattice_point(rows, row, first);
    corners[1] = lattice_point(rows, row + 1, inverted ? first + 1 : first);
    corners[2] = inverted ? lattice_point(rows, row, first + 1)
                          : lattice_point(rows, row + 1, first + 1);
}

// The row and the number in the row of a lattice's point.
ivec2 lattice_row_of(uint number) {
    int row = (root_of(8u * number + 1u) - 1) / 2;
    return ivec2(row, int(number) - row * (row + 1) / 2);
}

uint lattice_number(int row, int column) {
    return uint(row * (row + 1) / 2 + column);
}

base_patch patch_of(uint number) {
    base_patch result;
    uint parts = 2u * constants.depth;
    result.triangle = number >> parts;
    lattice_triangle(1 << constants.depth, number & ((1u << parts) - 1u), result.corners);
    return result;
}

// A place in a patch, from weights of its corners of sum `segments`.
base_place place_in_patch(base_patch parts, ivec3 weights, int segments) {
    ivec3 sum = weights.x * parts.corners[0] + weights.y * parts.corners[1] +
                weights.z * parts.corners[2];
    return base_place(parts.triangle, ((1 << PATCH_MOST) / segments) * sum);
}

// Segments of an edge, from the log2 of its length over the spacing of vertices.
int segments_of(float size) {
    return 1 << int(clamp(ceil(size), 0.0, float(PATCH_MOST)));
}

// How far vertices with odd numbers have moved from between their neighbours to their own places,
// (0, 1].
float segments_grown(float size) {
    return 1.0 - (ceil(size) - size);
}

// Vertices and triangles. With two segments a patch has a vertex more, in the middle.
uvec2 counts_of(int segments) {
    uvec2 lattice = uvec2((segments + 1) * (segments + 2) / 2, segments * segments);
    return segments == 2 ? lattice + uvec2(1u, 2u) : lattice;
}

// With two segments: the corners and the middles of the edges, from the end where the largest edge
// begins: even numbers are corners, and the last corner is opposite of that edge.
ivec3 point_around(vec4 sizes, int number) {
    int edge = sizes.x == sizes.w ? 0 : sizes.y == sizes.w ? 1 : 2;
    ivec3 first = ivec3(edge == 0, edge == 1, edge == 2);
    ivec3 corners[3] = ivec3[3](first, first.zxy, first.yzx);
    return corners[number / 2] + corners[(number + 1) / 2 % 3];
}

// Where a patch is not seen.
const float PATCH_CULLED = -1e30;

// Vertices and triangles of a patch whose longest edge has this size, with vertices 2^spacing times
// as far apart.
uvec2 patch_counts(float largest, float spacing) {
    return largest == PATCH_CULLED ? uvec2(0u) : counts_of(segments_of(largest - spacing));
}

#endif
