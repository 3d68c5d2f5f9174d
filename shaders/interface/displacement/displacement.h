#ifndef INTERFACE_DISPLACEMENT_H
#define INTERFACE_DISPLACEMENT_H

#include "../types.h"

// Displaced surfaces. The base mesh is welded: vertices at one place are one *point*, whatever
// their normals and texture coordinates; a *chart* of a point is one set of texture coordinates
// there. A *patch* is a triangle of the base mesh or, where those are large, one of the 4^depth
// equal parts of one.

// An edge of a patch has at most 2^PATCH_MOST segments.
#define PATCH_MOST 6
// Patches are counted by the sizes of their largest edges, in bins of 1/PATCH_STEPS: bin i ends at
// i/PATCH_STEPS - 1. One patch counts PATCH_BIN_UNITS: integers, whose sum is the same in any
// order.
#define PATCH_STEPS     16
#define PATCH_BINS      ((PATCH_MOST + 1) * PATCH_STEPS + 2)
#define PATCH_BIN_UNITS 1024u
// Heights are means over squares as wide as vertices are apart, up to k 2^this pixels.
#define PATCH_WIDEST 4
// Lights whose shadows decide what is not culled.
#define PATCH_CASTERS 4
// What the picture does not show, but whose shadow may fall into it, has vertices 2^this times as
// far apart.
#define PATCH_UNSEEN 2
// Threads of the group that adds up the counts of all patches.
#define PATCH_GROUP 256

// The base mesh (std430): written once.
struct base_triangle {
    uint charts[3]; // of its corners
    uint edges[3];  // welded; number i begins at corner i
};
INTERFACE_SIZE(base_triangle, 24)
INTERFACE_OFFSET(base_triangle, edges, 12)

struct base_edge {
    uint points[2];  // its ends, in ascending order
    uint first_pair; // of charts at both ends: one for each chart that has the edge
    uint pair_count;
};
INTERFACE_SIZE(base_edge, 16)
INTERFACE_OFFSET(base_edge, first_pair, 8)
INTERFACE_OFFSET(base_edge, pair_count, 12)

struct base_chart {
    uint point;
    uint vertex; // of the mesh, with the chart's texture coordinates
};
INTERFACE_SIZE(base_chart, 8)
INTERFACE_OFFSET(base_chart, vertex, 4)

struct base_point {
    uint first_chart, chart_count;
    uint first_corner, corner_count; // of the mesh that lie here
};
INTERFACE_SIZE(base_point, 16)
INTERFACE_OFFSET(base_point, chart_count, 4)
INTERFACE_OFFSET(base_point, first_corner, 8)
INTERFACE_OFFSET(base_point, corner_count, 12)

// A point in the mesh's pose, in object space.
struct posed_point {
    float position[3];
    float direction[3]; // of displacement: unit
};
INTERFACE_SIZE(posed_point, 24)
INTERFACE_OFFSET(posed_point, direction, 12)

// Push constants of the passes that pose points and measure charts.
struct pose_constants {
    uint count;      // of points or charts
    uint second_set; // of texture coordinates
    uint row;        // threads in a row of the dispatch
    uint padding_0;
    float4 map_rows[2]; // of the coordinates' transform
    float width;        // texels of the map
    float height;
    float padding_1;
    float padding_2;
};
INTERFACE_SIZE(pose_constants, 64)
INTERFACE_OFFSET(pose_constants, second_set, 4)
INTERFACE_OFFSET(pose_constants, row, 8)
INTERFACE_OFFSET(pose_constants, map_rows, 16)
INTERFACE_OFFSET(pose_constants, width, 48)
INTERFACE_OFFSET(pose_constants, height, 52)

// How a map lies on the mesh around a chart (std430).
struct chart_measure {
    float lengths[2]; // over which u and v grow by 1, the object's
    float edge;       // texels along the longest edge of the triangles that have it
};
INTERFACE_SIZE(chart_measure, 12)
INTERFACE_OFFSET(chart_measure, edge, 8)

// Texels along each side of the squares of which the least and the greatest heights are kept; then
// of four of them, and so on, to one for the map. Four floats each: the least, the greatest, and
// the greatest change from a texel to the next along u and v.
#define HEIGHT_BOUNDS_TEXELS 8
struct height_bounds_constants {
    uint width; // texels of the map
    uint height;
    uint columns; // squares to write
    uint rows;
    uint target;         // the first of them
    uint source;         // the first to read
    uint source_columns; // 0: from the map
    uint source_rows;
};
INTERFACE_SIZE(height_bounds_constants, 32)
INTERFACE_OFFSET(height_bounds_constants, height, 4)
INTERFACE_OFFSET(height_bounds_constants, columns, 8)
INTERFACE_OFFSET(height_bounds_constants, rows, 12)
INTERFACE_OFFSET(height_bounds_constants, target, 16)
INTERFACE_OFFSET(height_bounds_constants, source, 20)
INTERFACE_OFFSET(height_bounds_constants, source_columns, 24)
INTERFACE_OFFSET(height_bounds_constants, source_rows, 28)

// One displaced instance, seen by a camera (std140). Lengths are metres in the world unless they
// are said to be the object's. What follows the instance's motion is not first: lavapipe (Mesa
// 22.3) compiles these passes again, for seconds, whenever the first number of this block changes.
struct displacement_constants {
    uint width, height;  // texels of the height map
    uint wrap_u, wrap_v; // WRAP_...
    uint second_set;     // of texture coordinates
    uint levels;         // of the height map
    uint patch_count;
    uint depth;         // patches of a triangle: 4^depth
    float4 rows[3];     // object to world
    float4 axis;        // unit view direction; w: its product with the eye's position
    float4 planes[5];   // of the view's frustum: unit, inwards, at least 0 inside
    float4 map_rows[2]; // of the transform of the height map's coordinates
    float pixels;       // per metre: at a distance of one metre, or everywhere
    float perspective;  // 1: the former
    float near_plane;
    float spacing; // of vertices, pixels
    float relief;  // of height 1, the object's lengths
    float stretch; // metres per object's length, at most
    float scale;   // the same, on the average
    float facing;  // which way fronts wind: 1, -1 if mirrored; 0: backs are seen, too
    uint row;      // threads in a row of the dispatch
    uint vertex_room, triangle_room;
    uint caster_count; // lights that cast shadows; above PATCH_CASTERS: only some are listed
    float4 eye;        // w: 0: no place
    // Where a light is (w: 1), or which way it shines (w: 0).
    float4 casters[PATCH_CASTERS];
    uint bounds_levels; // of the squares with the heights' bounds
    uint padding_0;
    uint padding_1;
    uint padding_2;
};
INTERFACE_SIZE(displacement_constants, 352)
INTERFACE_OFFSET(displacement_constants, height, 4)
INTERFACE_OFFSET(displacement_constants, wrap_u, 8)
INTERFACE_OFFSET(displacement_constants, wrap_v, 12)
INTERFACE_OFFSET(displacement_constants, second_set, 16)
INTERFACE_OFFSET(displacement_constants, levels, 20)
INTERFACE_OFFSET(displacement_constants, patch_count, 24)
INTERFACE_OFFSET(displacement_constants, depth, 28)
INTERFACE_OFFSET(displacement_constants, rows, 32)
INTERFACE_OFFSET(displacement_constants, axis, 80)
INTERFACE_OFFSET(displacement_constants, planes, 96)
INTERFACE_OFFSET(displacement_constants, map_rows, 176)
INTERFACE_OFFSET(displacement_constants, pixels, 208)
INTERFACE_OFFSET(displacement_constants, perspective, 212)
INTERFACE_OFFSET(displacement_constants, near_plane, 216)
INTERFACE_OFFSET(displacement_constants, spacing, 220)
INTERFACE_OFFSET(displacement_constants, relief, 224)
INTERFACE_OFFSET(displacement_constants, stretch, 228)
INTERFACE_OFFSET(displacement_constants, scale, 232)
INTERFACE_OFFSET(displacement_constants, facing, 236)
INTERFACE_OFFSET(displacement_constants, row, 240)
INTERFACE_OFFSET(displacement_constants, vertex_room, 244)
INTERFACE_OFFSET(displacement_constants, triangle_room, 248)
INTERFACE_OFFSET(displacement_constants, caster_count, 252)
INTERFACE_OFFSET(displacement_constants, eye, 256)
INTERFACE_OFFSET(displacement_constants, casters, 272)
INTERFACE_OFFSET(displacement_constants, bounds_levels, 336)

#define WRAP_REPEAT 0
#define WRAP_MIRROR 1
#define WRAP_CLAMP  2

// What the passes tell each other and the draws (storage buffer of uint).
#define PATCH_DRAW      0  // lobe_draw_arguments
#define PATCH_VERTICES  5  // lobe_dispatch_arguments: a thread for each vertex
#define PATCH_TRIANGLES 8  // lobe_dispatch_arguments: a thread for each triangle
#define PATCH_SPACING   11 // float: log2 of the distance of vertices over k pixels
#define PATCH_TOTALS    12 // vertices, triangles
#define PATCH_WORDS     14

// The first vertex of a displaced surface is none: position[0] is the distance of vertices over k
// pixels.
#define PATCH_FIRST_VERTEX 1

#endif
