// Cameras: where points of the world are projected in a picture, at any sample of a pixel.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "passes/context/camera.h"
#include "scenes/builtin/random.h"

enum { WIDTH = 40, HEIGHT = 30 };

static lobe_camera camera_with(float field_of_view) {
    return (lobe_camera){.eye = {1, 2, 3},
                         .target = {-0.5f, 0.25f, -1},
                         .up = {0.1f, 1, 0},
                         .vertical_field_of_view = field_of_view,
                         .orthographic_height = 2.5f,
                         .near_plane = 0.5f};
}

static const float minimum[3] = {-20, -20, -20}, maximum[3] = {20, 20, 20};

/// Continuous pixel coordinates, from the upper left corner, and depth.
static void project(const lobe_camera *camera, const float sample[2], const float point[3],
                    double pixel[3]) {
    mat4 matrix;
    vec4 clip, from = {point[0], point[1], point[2], 1};
    passes_camera_projection(camera, WIDTH, HEIGHT, sample, minimum, maximum, matrix);
    glm_mat4_mulv(matrix, from, clip);
    pixel[0] = (0.5 + 0.5 * (double)(clip[0] / clip[3])) * WIDTH;
    pixel[1] = (0.5 + 0.5 * (double)(clip[1] / clip[3])) * HEIGHT;
    pixel[2] = (double)(clip[2] / clip[3]);
}

static void random_point(random_sequence *sequence, float point[3]) {
    for (int i = 0; i < 3; i++)
        point[i] = (float)scenes_random_between(sequence, -1, 1);
}

static const float fields_of_view[] = {0, 0.3f, 1.2f};
static const float centre[2] = {0.5f, 0.5f};

static void the_target_is_in_the_middle(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        lobe_camera camera = camera_with(fields_of_view[i]);
        double pixel[3];
        project(&camera, centre, camera.target, pixel);
        assert_true(fabs(pixel[0] - WIDTH / 2.0) < 1e-4 && fabs(pixel[1] - HEIGHT / 2.0) < 1e-4);
        // Points above it are higher in the picture, where y is smaller.
        float above[3] = {camera.target[0], camera.target[1] + 0.3f, camera.target[2]};
        project(&camera, centre, above, pixel);
        assert_true(pixel[1] < HEIGHT / 2.0 - 0.5);
    }
}

/// A point at a sample's position is drawn at the pixel's centre.
static void samples_move_the_picture_the_right_way(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(181);
    for (int i = 0; i < 60; i++) {
        lobe_camera camera = camera_with(fields_of_view[i % 3]);
        float point[3], sample[2] = {(float)scenes_random_between(&sequence, 0, 1),
                                     (float)scenes_random_between(&sequence, 0, 1)};
        double still[3], moved[3];
        random_point(&sequence, point);
        project(&camera, centre, point, still);
        project(&camera, sample, point, moved);
        for (int axis = 0; axis < 2; axis++)
            assert_true(fabs(moved[axis] - (still[axis] + 0.5 - (double)sample[axis])) < 1e-4);
        assert_true(fabs(moved[2] - still[2]) < 1e-6);
    }
}

static void shifts_are_in_heights_of_the_picture(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(182);
    for (int i = 0; i < 60; i++) {
        lobe_camera camera = camera_with(fields_of_view[i % 3]);
        double still[3], moved[3];
        float point[3];
        random_point(&sequence, point);
        project(&camera, centre, point, still);
        for (int axis = 0; axis < 2; axis++)
            camera.shift[axis] = (float)scenes_random_between(&sequence, -1, 1);
        project(&camera, centre, point, moved);
        for (int axis = 0; axis < 2; axis++)
            assert_true(fabs(moved[axis] - (still[axis] - HEIGHT * (double)camera.shift[axis])) <
                        1e-3);
        assert_true(fabs(moved[2] - still[2]) < 1e-6);
    }
}

/// Sampled to the right of its centre, a pixel shows what is there.
static void jitter_is_in_pixels(void **state) {
    (void)state;
    random_sequence sequence = scenes_random_start(183);
    for (int i = 0; i < 60; i++) {
        lobe_camera camera = camera_with(fields_of_view[i % 3]);
        double still[3], moved[3];
        float point[3];
        random_point(&sequence, point);
        project(&camera, centre, point, still);
        for (int axis = 0; axis < 2; axis++)
            camera.jitter[axis] = (float)scenes_random_between(&sequence, -1, 1);
        project(&camera, centre, point, moved);
        for (int axis = 0; axis < 2; axis++)
            assert_true(fabs(moved[axis] - (still[axis] - (double)camera.jitter[axis])) < 1e-4);
        assert_true(fabs(moved[2] - still[2]) < 1e-6);
    }
}

/// Reversed depth: 1 at the near plane, less behind it, never below 0 within the bounds.
static void depth_falls_with_distance(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        lobe_camera camera = camera_with(fields_of_view[i]);
        vec4 axis;
        passes_camera_axis(&camera, axis);
        double before = 2;
        for (double distance = 0.5; distance < 20; distance *= 1.5) {
            float point[3];
            double pixel[3];
            for (int j = 0; j < 3; j++)
                point[j] = camera.eye[j] + axis[j] * (float)distance;
            project(&camera, centre, point, pixel);
            if (distance == 0.5)
                assert_true(fabs(pixel[2] - 1) < 1e-5);
            assert_true(pixel[2] < before && pixel[2] > 0);
            before = pixel[2];
            double along = (double)(axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2]);
            assert_true(fabs(along - (double)axis[3] - distance) < 1e-4);
        }
    }
}

/// The depths of an orthographic picture do not depend on the unit of length.
static void orthographic_depth_has_no_scale(void **state) {
    (void)state;
    for (int power = -40; power <= 40; power += 40) {
        const float scale = ldexpf(1, power);
        lobe_camera camera = {.eye = {0, 0, 2 * scale},
                              .up = {0, 1, 0},
                              .orthographic_height = scale,
                              .near_plane = 0.5f * scale};
        const float low[3] = {-scale, -scale, -scale}, high[3] = {scale, scale, scale};
        mat4 matrix;
        passes_camera_projection(&camera, WIDTH, HEIGHT, centre, low, high, matrix);
        vec4 clip, from = {0, 0, 0.5f * scale, 1};
        glm_mat4_mulv(matrix, from, clip);
        // From 0.5 to 1.01 * 3.
        assert_true(fabs((double)clip[2] - (1 - 1 / 2.53)) < 1e-5);
    }
}

static void check_rotation(const lobe_camera *camera) {
    mat3 rotation;
    passes_camera_rotation(camera, rotation);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            assert_true(fabsf(glm_vec3_dot(rotation[i], rotation[j]) - (i == j ? 1 : 0)) < 1e-5f);
    }
    assert_true(fabsf(glm_mat3_det(rotation) - 1) < 1e-5f);
}

/// For any camera, the axes are orthonormal and right-handed.
static void axes_are_orthonormal(void **state) {
    (void)state;
    lobe_camera camera = camera_with(1);
    check_rotation(&camera);
    // The up vector along the view, and the eye at the target.
    static const float ups[][3] = {{0, -1, 0}, {0, 1, 0}, {0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        camera = (lobe_camera){.eye = {0, 1, 0}, .up = {ups[i][0], ups[i][1], ups[i][2]}};
        check_rotation(&camera);
        camera.eye[1] = 0;
        camera.up[1] = 1;
        check_rotation(&camera);
    }
}

/// Neither the unit of length nor the length of the up vector turns the camera.
static void axes_have_no_scale(void **state) {
    (void)state;
    const lobe_camera whole = camera_with(1);
    mat3 expected, rotation;
    passes_camera_rotation(&whole, expected);
    for (int power = -60; power <= 60; power += 30) {
        lobe_camera camera = whole;
        for (int i = 0; i < 3; i++) {
            camera.eye[i] = ldexpf(whole.eye[i], power);
            camera.target[i] = ldexpf(whole.target[i], power);
            camera.up[i] = ldexpf(whole.up[i], -power);
        }
        passes_camera_rotation(&camera, rotation);
        assert_memory_equal(rotation, expected, sizeof rotation);
    }
}

/// The eye of an orthographic camera is a direction, to the viewer.
static void the_eye_is_a_place_or_a_direction(void **state) {
    (void)state;
    vec4 eye;
    lobe_camera camera = camera_with(1);
    passes_camera_eye(&camera, eye);
    assert_true(eye[0] == 1 && eye[1] == 2 && eye[2] == 3 && eye[3] == 1);
    camera = camera_with(0);
    vec4 axis;
    passes_camera_axis(&camera, axis);
    passes_camera_eye(&camera, eye);
    assert_true(eye[3] == 0);
    for (int i = 0; i < 3; i++)
        assert_true(fabsf(eye[i] + axis[i]) < 1e-6f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_target_is_in_the_middle),
        cmocka_unit_test(samples_move_the_picture_the_right_way),
        cmocka_unit_test(shifts_are_in_heights_of_the_picture),
        cmocka_unit_test(jitter_is_in_pixels),
        cmocka_unit_test(depth_falls_with_distance),
        cmocka_unit_test(orthographic_depth_has_no_scale),
        cmocka_unit_test(axes_are_orthonormal),
        cmocka_unit_test(axes_have_no_scale),
        cmocka_unit_test(the_eye_is_a_place_or_a_direction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
