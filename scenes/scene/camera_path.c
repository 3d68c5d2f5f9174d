#include <math.h>

#include <lobe/scene.h>

#include "scenes/mesh/circle.h"
#include "scenes/mesh/vector.h"

// Powers of two by which the distance has grown at the farthest point of the path, and on its turn:
// 64 and 8 times.
static const double farthest = 6, middle = 3;

// The path returns from its farthest point at the same speed.
static double growth(double part) {
    double out = fmin(part, 0.5) * 2 * farthest;
    double back = fmax(part - 0.5, 0) * 2 * farthest;
    return exp2(part <= 0.5 ? out : fmax(farthest - back, middle));
}

static vector3 turn(vector3 v, const double point[2]) {
    return (vector3){point[0] * v.x + point[1] * v.z, v.y, point[0] * v.z - point[1] * v.x};
}

void lobe_scene_path(const lobe_scene *scene, double part, lobe_camera *camera) {
    if (!scene || !camera)
        return;
    *camera = scene->camera;
    if (!(part > 0))
        return;
    part = fmin(part, 1);
    const vector3 target = vector3_load(camera->target);
    const vector3 reach = vector3_subtract(vector3_load(camera->eye), target);
    const double scale = growth(part);
    double point[2];
    scenes_circle_point(fmax(part - 0.5, 0) * 2, point);
    vector3_store(vector3_add(target, turn(vector3_scale(reach, scale), point)), camera->eye);
    vector3_store(turn(vector3_load(camera->up), point), camera->up);
    camera->orthographic_height = (float)(scale * camera->orthographic_height);
    camera->near_plane = (float)(scale * camera->near_plane);
}
