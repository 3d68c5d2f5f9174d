// What a camera sees of a box: its nearest point, against many points of the box that are projected
// one by one.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "passes/context/camera.h"
#include "passes/context/view_volume.h"
#include "scenes/builtin/random.h"

enum { WIDTH = 64, HEIGHT = 36, BOXES = 400, STEPS = 20 };

static const lobe_camera camera = {.eye = {1, 2, 3},
                                   .target = {-0.5f, 0.25f, -1},
                                   .up = {0.1f, 1, 0},
                                   .vertical_field_of_view = 0.9f,
                                   .near_plane = 0.5f,
                                   .shift = {0.2f, -0.1f}};

typedef struct box {
    float transform[16], minimum[3], maximum[3];
} box;

/// Anywhere around the camera, from flat and small ones to one that holds it.
static box random_box(random_sequence *sequence) {
    box result = {.transform = {[15] = 1}};
    const float size = (float)exp(scenes_random_between(sequence, -2, 1.5)),
                ahead = (float)scenes_random_between(sequence, -0.5, 2);
    for (int i = 0; i < 3; i++) {
        for (int column = 0; column < 3; column++)
            result.transform[4 * column + i] = size * (float)scenes_random_between(sequence, -1, 1);
        result.transform[12 + i] = camera.eye[i] + ahead * (camera.target[i] - camera.eye[i]) +
                                   (float)scenes_random_between(sequence, -2, 2);
        result.minimum[i] = (float)scenes_random_between(sequence, -1, 0);
        result.maximum[i] = result.minimum[i] + (float)scenes_random_between(sequence, 0, 2);
    }
    if (scenes_random_between(sequence, 0, 1) < 0.3)
        result.maximum[1] = result.minimum[1];
    return result;
}

/// One that holds all that the camera sees up to some distance.
static box box_around_camera(random_sequence *sequence) {
    box result = {.transform = {[15] = 1}, .minimum = {-1, -1, -1}, .maximum = {1, 1, 1}};
    for (int i = 0; i < 3; i++) {
        result.transform[5 * i] = (float)scenes_random_between(sequence, 5, 10);
        result.transform[12 + i] = camera.eye[i];
    }
    return result;
}

static void point_of(const box *box, const double place[3], float point[3]) {
    float own[3];
    for (int i = 0; i < 3; i++)
        own[i] = box->minimum[i] + (float)place[i] * (box->maximum[i] - box->minimum[i]);
    for (int row = 0; row < 3; row++)
        point[row] = box->transform[row] * own[0] + box->transform[4 + row] * own[1] +
                     box->transform[8 + row] * own[2] + box->transform[12 + row];
}

/// How points are projected.
typedef struct projection {
    mat4 matrix;
    vec4 axis;
} projection;

static projection project(void) {
    static const float middle[2] = {0.5f, 0.5f}, anywhere[3] = {0};
    projection result;
    passes_camera_projection(&camera, WIDTH, HEIGHT, middle, anywhere, anywhere, result.matrix);
    passes_camera_axis(&camera, result.axis);
    return result;
}

/// The depth of a point in a picture that is wider by `border` pixels on each side; INFINITY
/// outside.
static double seen_depth(projection *view, const float point[3], double border) {
    vec4 clip, from = {point[0], point[1], point[2], 1};
    glm_mat4_mulv(view->matrix, from, clip);
    const double depth = (double)(glm_vec3_dot(view->axis, from) - view->axis[3]);
    const double x = fabs((double)(clip[0] / clip[3])), y = fabs((double)(clip[1] / clip[3]));
    return depth >= (double)camera.near_plane && x <= 1 + 2 * border / WIDTH &&
                   y <= 1 + 2 * border / HEIGHT
               ? depth
               : INFINITY;
}

static double nearest_of_points(const box *box, double border) {
    double nearest = INFINITY, place[3];
    float point[3];
    projection view = project();
    for (int i = 0; i <= STEPS; i++) {
        for (int j = 0; j <= STEPS; j++) {
            for (int k = 0; k <= STEPS; k++) {
                place[0] = (double)i / STEPS, place[1] = (double)j / STEPS;
                place[2] = (double)k / STEPS;
                point_of(box, place, point);
                nearest = fmin(nearest, seen_depth(&view, point, border));
            }
        }
    }
    return nearest;
}

/// The longest distance between neighbours among the points.
static double spacing_of(const box *box) {
    double sum = 0;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            sum += fabs((double)(box->transform[4 * column + row] *
                                 (box->maximum[column] - box->minimum[column])));
    return sum / STEPS;
}

static void nearest_point_is_what_the_picture_shows(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(7);
    view_volume volume;
    passes_view_volume_make(&camera, WIDTH, HEIGHT, &volume);
    int hidden = 0, cut = 0, near = 0;
    for (int i = 0; i < BOXES; i++) {
        const box box = i % 20 == 0 ? box_around_camera(&sequence) : random_box(&sequence);
        const double found =
            (double)passes_view_volume_nearest(&volume, box.transform, box.minimum, box.maximum);
        const double expected = nearest_of_points(&box, 0);
        if (found > expected * (1 + 1e-5) + 1e-5)
            fail_msg("box %d: nearest at %g, but %g is seen", i, found, expected);
        // Points miss what is narrower than their spacing.
        const double most = nearest_of_points(&box, 3);
        if (isfinite(most) && found < most - 2 * spacing_of(&box) - 1e-4)
            fail_msg("box %d: nearest at %g instead of %g", i, found, most);
        hidden += !isfinite(found);
        near += found <= (double)camera.near_plane * 1.00001;
        cut += isfinite(expected) && expected > 1.2 * (double)camera.near_plane;
    }
    if (hidden < 50 || cut < 50 || near < 5)
        fail_msg("%d hidden, %d beyond and %d at the near plane: not all is tested", hidden, cut,
                 near);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_point_is_what_the_picture_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
