#include "scenes/builtin/hall/lathe.h"

#include <math.h>

#include "scenes/mesh/circle.h"
#include "scenes/mesh/grid_mesh.h"

static double stretch_length(const double (*outline)[2], size_t index) {
    double x = outline[index + 1][0] - outline[index][0];
    double y = outline[index + 1][1] - outline[index][1];
    return sqrt(x * x + y * y);
}

// Slope of the curve at a point per metre of chord: that of the chord between its neighbours.
static double slope(const lathe_shape *shape, size_t index, int axis) {
    size_t before = index > 0 ? index - 1 : 0;
    size_t after = index + 1 < shape->count ? index + 1 : index;
    double length = 0;
    for (size_t i = before; i < after; i++)
        length += stretch_length(shape->outline, i);
    return (shape->outline[after][axis] - shape->outline[before][axis]) / length;
}

// Catmull and Rom 1974, "A Class of Local Interpolating Splines", parameterised by chord length, so
// that it does not overshoot where short chords follow long ones.
static double interpolate(const lathe_shape *shape, size_t index, double t, int axis) {
    double length = stretch_length(shape->outline, index), from = shape->outline[index][axis];
    double rise = shape->outline[index + 1][axis] - from;
    double first = slope(shape, index, axis) * length,
           last = slope(shape, index + 1, axis) * length;
    return from + t * (first + t * (3 * rise - 2 * first - last + t * (first + last - 2 * rise)));
}

static void place(const void *argument, double u, double v, lobe_scene_vertex *vertex) {
    const lathe_shape *shape = argument;
    size_t stretches = shape->count - 1, index = (size_t)(v * (double)stretches);
    index = index < stretches ? index : stretches - 1;
    double t = v * (double)stretches - (double)index, around[2], length = 0;
    double radius = interpolate(shape, index, t, 0);
    for (size_t i = 0; i < index; i++)
        length += stretch_length(shape->outline, i);
    length += t * stretch_length(shape->outline, index);
    scenes_circle_point(u, around);
    vertex->position[0] = (float)(radius * around[1]);
    vertex->position[1] = (float)interpolate(shape, index, t, 1);
    vertex->position[2] = (float)(radius * around[0]);
    vertex->texture_coordinates[0][0] = (float)(u * shape->tiles_around);
    vertex->texture_coordinates[0][1] = (float)(length / shape->tile);
}

lobe_result scenes_lathe_make(const lathe_shape *shape, const lobe_host *host, lobe_mesh *mesh) {
    const grid_mesh grid = {.name = shape->name,
                            .rows = (uint32_t)(shape->count - 1) * shape->cuts,
                            .columns = shape->columns,
                            .closed = true,
                            .place = place,
                            .shape = shape};
    return scenes_grid_mesh_make(&grid, host, mesh);
}
