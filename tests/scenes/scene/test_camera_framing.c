// The camera that frames a scene: the picture contains all of it, as large as possible.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include <lobe/scene.h>

#include "scenes/mesh/vector.h"

/// The bounds of a box in the picture, [-1, 1] across and upright, and the distance of its nearest
/// corner.
typedef struct placement {
    double left, right, bottom, top, nearest;
} placement;

static placement place(const lobe_camera *camera, const float low[3], const float high[3],
                       double aspect) {
    const vector3 eye = vector3_load(camera->eye);
    vector3 forward = vector3_subtract(vector3_load(camera->target), eye);
    assert_true(vector3_normalise(&forward, 0));
    vector3 right = vector3_cross(forward, vector3_load(camera->up));
    assert_true(vector3_normalise(&right, 0));
    const vector3 up = vector3_cross(right, forward);
    const double tangent = tan(camera->vertical_field_of_view / 2);
    placement box = {INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY};
    for (int corner = 0; corner < 8; corner++) {
        const vector3 p = {corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                           corner & 4 ? high[2] : low[2]};
        const vector3 towards = vector3_subtract(p, eye);
        const double z = vector3_dot(towards, forward);
        const double x = vector3_dot(towards, right) / (z * tangent * aspect);
        const double y = vector3_dot(towards, up) / (z * tangent);
        box = (placement){fmin(box.left, x), fmax(box.right, x), fmin(box.bottom, y),
                          fmax(box.top, y), fmin(box.nearest, z)};
    }
    return box;
}

static const double aspects[] = {16.0 / 9, 1, 0.5, 2};

/// A scene of one mesh whose vertices are the corners of a box; half of them are in a separate,
/// moved instance, so that transforms matter.
typedef struct box_scene {
    lobe_scene_vertex corners[8];
    lobe_mesh meshes[2];
    lobe_instance instances[2];
    lobe_scene scene;
} box_scene;

static void make_scene(const float low[3], const float high[3], box_scene *box) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    *box = (box_scene){0};
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 0; axis < 3; axis++)
            box->corners[corner].position[axis] = (corner >> axis & 1 ? high : low)[axis];
    for (uint32_t i = 0; i < 2; i++) {
        box->meshes[i] = (lobe_mesh){.vertices = box->corners + 4 * i, .vertex_count = 4};
        box->instances[i] = (lobe_instance){.mesh = i};
        memcpy(box->instances[i].transform, identity, sizeof identity);
    }
    // The second half, at z = high, is relative to its own origin.
    for (int corner = 4; corner < 8; corner++)
        box->corners[corner].position[2] = 0;
    box->instances[1].transform[14] = high[2];
    box->scene = (lobe_scene){
        .meshes = box->meshes, .mesh_count = 2, .instances = box->instances, .instance_count = 2};
    memcpy(box->scene.minimum, low, sizeof box->scene.minimum);
    memcpy(box->scene.maximum, high, sizeof box->scene.maximum);
}

static placement frame(const float low[3], const float high[3], double aspect,
                       lobe_camera *camera) {
    box_scene box;
    make_scene(low, high, &box);
    lobe_scene_frame(&box.scene, aspect, camera);
    return place(camera, low, high, aspect);
}

static void scenes_touch_the_margin_and_are_in_the_middle(void **state) {
    (void)state;
    static const float boxes[][2][3] = {
        {{-1, -1, -1}, {1, 1, 1}},
        {{0, 0, 0}, {1, 0.2f, 0.6f}},
        {{-5, 0, -5}, {5, 0, 5}},
        {{2, -3, 7}, {2.5f, 4, 7.25f}},
        {{0, 0, 0}, {0, 3, 0}},
        {{1000, 1000, 1000}, {1000.5f, 1001, 1000.5f}},
        {{-1e17f, 0, 0}, {1e17f, 1, 1}},
        {{-1e-6f, 0, 0}, {1e-6f, 1e-6f, 1e-6f}},
        {{-3, 0, -0.1f}, {3, 0.1f, 0.1f}},
    };
    for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++)
        for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
            lobe_camera camera;
            const placement box = frame(boxes[b][0], boxes[b][1], aspects[a], &camera);
            const double width = fmax(-box.left, box.right), height = fmax(-box.bottom, box.top);
            assert_true(fabs(fmax(width, height) - 0.95) < 0.002);
            assert_true(camera.near_plane > 0 && camera.near_plane < box.nearest);
            assert_true(fabs(box.left + box.right) < 0.01);
            assert_true(fabs(box.bottom + box.top) < 0.01);
        }
}

/// An empty corner of the bounds takes up no space in the picture.
static void empty_corners_take_no_room(void **state) {
    (void)state;
    const float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    box_scene box;
    make_scene(low, high, &box);
    box.scene.minimum[1] = -9;
    lobe_camera camera;
    lobe_scene_frame(&box.scene, 1, &camera);
    const placement seen = place(&camera, low, high, 1);
    assert_true(fabs(seen.right - 0.95) < 0.002 || fabs(seen.top - 0.95) < 0.002);
}

/// A scene that is long in the direction of sight could reach up to the eye.
static void the_eye_keeps_away_from_what_is_long(void **state) {
    (void)state;
    const float low[3] = {-0.001f, -0.001f, -50}, high[3] = {0.001f, 0.001f, 50};
    for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
        lobe_camera camera;
        const placement box = frame(low, high, aspects[a], &camera);
        assert_true(box.nearest > 20);
        assert_true(box.left > -1 && box.right < 1 && box.bottom > -1 && box.top < 1);
    }
}

static void a_point_is_seen_from_afar(void **state) {
    (void)state;
    const float point[3] = {4, 5, 6};
    lobe_camera camera;
    const placement box = frame(point, point, 1, &camera);
    assert_true(box.nearest > 1 && box.nearest < 20);
    assert_true(fabs(box.left) < 0.5 && fabs(box.top) < 0.5);
}

/// The vertices of a deformed mesh are found on the device: its bounds are framed.
static void deformed_meshes_are_where_their_bounds_are(void **state) {
    (void)state;
    static const float low[3] = {4, 5, 6}, high[3] = {7, 9, 8};
    lobe_deformation deformation = {0};
    lobe_camera expected, camera;
    box_scene box;
    for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
        frame(low, high, aspects[a], &expected);
        make_scene((float[]){-1, -1, -1}, (float[]){1, 1, 1}, &box);
        box.scene.instance_count = box.scene.mesh_count = 1;
        box.meshes[0].deformation = &deformation;
        memcpy(box.meshes[0].minimum, low, sizeof low);
        memcpy(box.meshes[0].maximum, high, sizeof high);
        memcpy(box.scene.minimum, low, sizeof low);
        memcpy(box.scene.maximum, high, sizeof high);
        lobe_scene_frame(&box.scene, aspects[a], &camera);
        for (int axis = 0; axis < 3; axis++) {
            assert_float_equal(camera.eye[axis], expected.eye[axis], 1e-4);
            assert_float_equal(camera.target[axis], expected.target[axis], 1e-4);
        }
    }
}

static void nothing_has_a_camera_too(void **state) {
    (void)state;
    const lobe_scene empty = {0};
    lobe_camera camera;
    lobe_scene_frame(&empty, 1, &camera);
    assert_true(camera.near_plane > 0 && camera.vertical_field_of_view > 0);
    for (int axis = 0; axis < 3; axis++)
        assert_true(isfinite(camera.eye[axis]) && isfinite(camera.target[axis]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_touch_the_margin_and_are_in_the_middle),
        cmocka_unit_test(empty_corners_take_no_room),
        cmocka_unit_test(the_eye_keeps_away_from_what_is_long),
        cmocka_unit_test(a_point_is_seen_from_afar),
        cmocka_unit_test(deformed_meshes_are_where_their_bounds_are),
        cmocka_unit_test(nothing_has_a_camera_too),
    };
    return cmocka_run_group_tests_name("camera that frames a scene", tests, NULL, NULL);
}
