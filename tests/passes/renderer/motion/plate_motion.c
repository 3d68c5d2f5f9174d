#include "tests/passes/renderer/motion/plate_motion.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3]) {
    for (int i = 0; i < 3; i++)
        result[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalise(double vector[3]) {
    const double length = sqrt(dot(vector, vector));
    for (int i = 0; i < 3; i++)
        vector[i] /= length;
}

/// To the right, down and along the view.
static void axes_of(const lobe_camera *camera, double axes[3][3]) {
    double up[3];
    for (int i = 0; i < 3; i++) {
        axes[2][i] = (double)camera->target[i] - (double)camera->eye[i];
        up[i] = camera->up[i];
    }
    normalise(axes[2]);
    cross(axes[2], up, axes[0]);
    normalise(axes[0]);
    cross(axes[2], axes[0], axes[1]);
}

/// Half the height of the picture at a distance of one.
static double half_height(const lobe_camera *camera) {
    return camera->vertical_field_of_view > 0 ? tan(0.5 * (double)camera->vertical_field_of_view)
                                              : 0.5 * (double)camera->orthographic_height;
}

/// From lengths to the right and down at a distance of one, or of any of an orthographic camera.
static void place_in_picture(const plate_view *view, const double lengths[2], double position[2]) {
    const double pixels = 0.5 * view->height / half_height(&view->camera);
    const double centre[2] = {0.5 * view->width, 0.5 * view->height};
    for (int i = 0; i < 2; i++)
        position[i] =
            centre[i] + pixels * lengths[i] - (double)view->camera.shift[i] * view->height;
}

static void ray_of(const plate_view *view, const uint32_t pixel[2], double origin[3],
                   double direction[3]) {
    const lobe_camera *camera = &view->camera;
    const bool perspective = camera->vertical_field_of_view > 0;
    const double size = 2 * half_height(camera) / view->height;
    double axes[3][3], lengths[2];
    axes_of(camera, axes);
    lengths[0] = size * (pixel[0] + 0.5 + (double)camera->jitter[0] - 0.5 * view->width +
                         (double)camera->shift[0] * view->height);
    lengths[1] = size * (pixel[1] + 0.5 + (double)camera->jitter[1] - 0.5 * view->height +
                         (double)camera->shift[1] * view->height);
    for (int i = 0; i < 3; i++) {
        const double aside = lengths[0] * axes[0][i] + lengths[1] * axes[1][i];
        origin[i] = camera->eye[i] + (perspective ? 0 : aside);
        direction[i] = axes[2][i] + (perspective ? aside : 0);
    }
}

static void transform_point(const float m[16], const double place[3], double point[3]) {
    for (int i = 0; i < 3; i++)
        point[i] = m[i] * place[0] + m[4 + i] * place[1] + m[8 + i] * place[2] + m[12 + i];
}

/// Solves x a + z b - distance d = o - t for the plane of a square.
static double meet(const float m[16], const double origin[3], const double direction[3],
                   double place[3]) {
    double a[3], b[3], offset[3], normal[3], point[3], other[3];
    for (int i = 0; i < 3; i++) {
        a[i] = m[i];
        b[i] = m[8 + i];
        offset[i] = m[12 + i] - origin[i];
    }
    cross(a, b, normal);
    const double distance = dot(offset, normal) / dot(direction, normal);
    for (int i = 0; i < 3; i++)
        point[i] = distance * direction[i] - offset[i];
    cross(b, normal, other);
    place[0] = dot(point, other) / dot(a, other);
    place[1] = 0;
    cross(a, normal, other);
    place[2] = dot(point, other) / dot(b, other);
    return distance;
}

plate_hit plate_seen(const plate_view *view, const float (*transforms)[16], size_t count,
                     const uint32_t pixel[2]) {
    double origin[3], direction[3], nearest = INFINITY;
    plate_hit found = {0};
    ray_of(view, pixel, origin, direction);
    for (size_t i = 0; i < count; i++) {
        double place[3];
        const double distance = meet(transforms[i], origin, direction, place);
        const double edge = fmax(fabs(place[0]), fabs(place[2]));
        if (!(distance > (double)view->camera.near_plane) || edge > 1.001)
            continue;
        found.unsure |= edge > 0.999 || fabs(distance - nearest) < 1e-3 * distance;
        if (distance > nearest)
            continue;
        nearest = distance;
        found.hit = true;
        found.plate = i;
        for (int k = 0; k < 3; k++)
            found.place[k] = place[k];
    }
    return found;
}

bool plate_projected(const plate_view *view, const float transform[16], const double place[3],
                     double position[2]) {
    double axes[3][3], point[3], lengths[2];
    axes_of(&view->camera, axes);
    transform_point(transform, place, point);
    for (int i = 0; i < 3; i++)
        point[i] -= view->camera.eye[i];
    const double depth = view->camera.vertical_field_of_view > 0 ? dot(point, axes[2]) : 1;
    for (int i = 0; i < 2; i++)
        lengths[i] = dot(point, axes[i]) / depth;
    place_in_picture(view, lengths, position);
    return depth > 0;
}

bool plate_distance_projected(const plate_view *view, const plate_view *from,
                              const uint32_t pixel[2], double position[2]) {
    double axes[3][3], origin[3], direction[3], lengths[2];
    ray_of(from, pixel, origin, direction);
    axes_of(&view->camera, axes);
    const double depth = dot(direction, axes[2]);
    for (int i = 0; i < 2; i++)
        lengths[i] = dot(direction, axes[i]) / depth;
    place_in_picture(view, lengths, position);
    return depth > 0 && view->camera.vertical_field_of_view > 0;
}
