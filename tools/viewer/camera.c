#include "tools/viewer/camera.h"

#include <math.h>
#include <string.h>

/// Smallest angle between the direction of view and the up vector, radians.
#define MINIMUM_ANGLE 0.02

static void subtract(const float a[3], const float b[3], double difference[3]) {
    for (int i = 0; i < 3; i++)
        difference[i] = (double)a[i] - b[i];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double length(const double vector[3]) {
    return sqrt(dot(vector, vector));
}

static void normalise(double vector[3]) {
    const double size = length(vector);
    for (int i = 0; i < 3 && size > 0; i++)
        vector[i] /= size;
}

static void cross(const double a[3], const double b[3], double product[3]) {
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/// Rodrigues: rotates a vector about a unit axis, counter-clockwise as seen from its tip.
static void turn(const double axis[3], double angle, double vector[3]) {
    double across[3];
    cross(axis, vector, across);
    const double along = dot(axis, vector) * (1 - cos(angle));
    for (int i = 0; i < 3; i++)
        vector[i] = vector[i] * cos(angle) + across[i] * sin(angle) + axis[i] * along;
}

/// Directions of the picture: to the right, upwards and into it; unit length.
typedef struct axes {
    double right[3], up[3], forward[3], upright[3];
    double distance; ///< from eye to target
} axes;

static axes axes_of(const lobe_camera *camera) {
    axes a;
    for (int i = 0; i < 3; i++)
        a.upright[i] = camera->up[i];
    normalise(a.upright);
    subtract(camera->target, camera->eye, a.forward);
    a.distance = length(a.forward);
    normalise(a.forward);
    cross(a.forward, a.upright, a.right);
    if (length(a.right) < 1e-6) {
        // Looking along the up vector: any perpendicular direction will do.
        const double other[3] = {fabs(a.forward[0]) < 0.5, 0, fabs(a.forward[0]) >= 0.5};
        cross(a.forward, other, a.right);
    }
    normalise(a.right);
    cross(a.right, a.forward, a.up);
    return a;
}

/// How far the view may be turned upwards without looking along the up vector.
static double limit_pitch(const axes *a, double up) {
    const double angle = acos(fmin(fmax(dot(a->forward, a->upright), -1), 1));
    return fmin(fmax(up, angle - (M_PI - MINIMUM_ANGLE)), angle - MINIMUM_ANGLE);
}

static void move(float point[3], const double direction[3], double size) {
    for (int i = 0; i < 3; i++)
        point[i] = (float)(point[i] + direction[i] * size);
}

void viewer_camera_orbit(lobe_camera *camera, double right, double up) {
    const axes a = axes_of(camera);
    double forward[3];
    memcpy(forward, a.forward, sizeof forward);
    turn(a.right, limit_pitch(&a, -up), forward);
    turn(a.upright, right, forward);
    memcpy(camera->eye, camera->target, sizeof camera->eye);
    move(camera->eye, forward, -a.distance);
}

void viewer_camera_look(lobe_camera *camera, double right, double up) {
    const axes a = axes_of(camera);
    double forward[3];
    memcpy(forward, a.forward, sizeof forward);
    turn(a.right, limit_pitch(&a, up), forward);
    turn(a.upright, -right, forward);
    memcpy(camera->target, camera->eye, sizeof camera->target);
    move(camera->target, forward, a.distance);
}

static double height_at_target(const lobe_camera *camera, double distance) {
    return camera->vertical_field_of_view > 0
               ? 2 * distance * tan(0.5 * camera->vertical_field_of_view)
               : camera->orthographic_height;
}

void viewer_camera_pan(lobe_camera *camera, double right, double up) {
    const axes a = axes_of(camera);
    const double height = height_at_target(camera, a.distance);
    move(camera->eye, a.right, right * height);
    move(camera->eye, a.up, up * height);
    move(camera->target, a.right, right * height);
    move(camera->target, a.up, up * height);
}

void viewer_camera_fly(lobe_camera *camera, const double steps[3]) {
    const axes a = axes_of(camera);
    const double *directions[3] = {a.right, a.up, a.forward};
    for (int i = 0; i < 3; i++) {
        move(camera->eye, directions[i], steps[i] * a.distance);
        move(camera->target, directions[i], steps[i] * a.distance);
    }
}

void viewer_camera_zoom(lobe_camera *camera, double factor) {
    const axes a = axes_of(camera);
    // Closer, eye and target would be one point in single precision.
    const double target[3] = {camera->target[0], camera->target[1], camera->target[2]};
    const double nearest = fmax(1e-6 * length(target), 1e-15);
    const double distance = fmin(fmax(a.distance * factor, nearest), 1e15);
    memcpy(camera->eye, camera->target, sizeof camera->eye);
    move(camera->eye, a.forward, -distance);
    // The planes scale with the distance; otherwise close objects would be cut away.
    camera->near_plane = (float)(camera->near_plane * distance / a.distance);
    camera->orthographic_height = (float)(camera->orthographic_height * distance / a.distance);
}
