#include <math.h>

#include "scenes/builtin/hall/hall.h"
#include "scenes/mesh/circle.h"
#include "scenes/mesh/grid_mesh.h"

static const double outer_radius = 1.66; // of the moulding around the arch, metres

// Profile of the arch, from the front of the wall around the inside to the back: distance from the
// arch's centre, and z. Two rolls, a face between them, and the flat inside.
static const double moulding[][2] = {
    {1.70, 0.28},  {1.67, 0.33},  {1.64, 0.36},  {1.60, 0.36},  {1.57, 0.33},
    {1.50, 0.33},  {1.47, 0.36},  {1.43, 0.35},  {1.40, 0.31},  {1.40, 0.10},
    {1.40, -0.10}, {1.40, -0.31}, {1.43, -0.35}, {1.47, -0.36}, {1.50, -0.33},
    {1.57, -0.33}, {1.60, -0.36}, {1.64, -0.36}, {1.67, -0.33}, {1.70, -0.28},
};
enum { STRETCHES = sizeof moulding / sizeof *moulding - 1, ARCH_COLUMNS = 28 };

static void place_arch(const void *unused, double u, double v, lobe_scene_vertex *vertex) {
    (void)unused;
    int row = (int)floor(v * STRETCHES + 0.5);
    double point[2], length = 0;
    scenes_circle_point(0.5 - u / 2, point);
    for (int i = 0; i < row; i++) {
        double radius = moulding[i + 1][0] - moulding[i][0],
               z = moulding[i + 1][1] - moulding[i][1];
        length += sqrt(radius * radius + z * z);
    }
    vertex->position[0] = (float)(moulding[row][0] * point[0]);
    vertex->position[1] = (float)(moulding[row][0] * point[1]);
    vertex->position[2] = (float)moulding[row][1];
    vertex->texture_coordinates[0][0] = (float)(u * 4);
    vertex->texture_coordinates[0][1] = (float)(length / HALL_MARBLE_TILE);
}

lobe_result scenes_hall_make_arch(const lobe_host *host, lobe_mesh *mesh) {
    static const grid_mesh grid = {
        .name = "arch", .rows = STRETCHES, .columns = ARCH_COLUMNS, .place = place_arch};
    return scenes_grid_mesh_make(&grid, host, mesh);
}

// The wall between the arch and a rectangle: each point on the rectangle's sides and top is joined
// to the point of the arch in the direction of the centre.
static void place_spandrel(const void *unused, double u, double v, lobe_scene_vertex *vertex) {
    (void)unused;
    double half = HALL_BAY / 2, along = u * (2 * HALL_WALL_HEIGHT + HALL_BAY) - HALL_WALL_HEIGHT;
    double x = fmin(fmax(along - half, -half), half);
    double y = HALL_WALL_HEIGHT - fmax(fmax(-along, along - HALL_BAY), 0);
    double inwards = outer_radius / sqrt(x * x + y * y), scale = 1 - v + v * inwards;
    vertex->position[0] = (float)(x * scale);
    vertex->position[1] = (float)(y * scale);
    vertex->position[2] = (float)(HALL_WALL_DEPTH / 2);
    vertex->texture_coordinates[0][0] = (float)(x * scale / HALL_MASONRY_TILE);
    vertex->texture_coordinates[0][1] = (float)(-y * scale / HALL_MASONRY_TILE);
}

lobe_result scenes_hall_make_spandrels(const lobe_host *host, lobe_mesh *mesh) {
    // A column of vertices ends at each corner of the rectangle, whose sides are 3.2, 3.6 and 3.2 m
    // long.
    static const grid_mesh grid = {
        .name = "spandrels", .rows = 1, .columns = 50, .place = place_spandrel};
    return scenes_grid_mesh_make(&grid, host, mesh);
}
