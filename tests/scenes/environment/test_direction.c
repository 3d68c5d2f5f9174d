// Where directions lie on the image of each layout, and back again.

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "scenes/environment/direction.h"

typedef struct shape {
    lobe_environment_layout layout;
    uint32_t width, height;
} shape;

static const shape shapes[] = {
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 64, 32},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 7, 5},
    {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 1, 1},
    {LOBE_ENVIRONMENT_CUBE_COLUMN, 8, 48},
    {LOBE_ENVIRONMENT_CUBE_ROW, 42, 7},
    {LOBE_ENVIRONMENT_VERTICAL_CROSS, 15, 20},
    {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 32, 24},
    {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 4, 3},
    {LOBE_ENVIRONMENT_CUBE_COLUMN, 1, 6},
};
enum { SHAPE_COUNT = sizeof shapes / sizeof *shapes };

static void assert_near(double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.17g instead of %.17g", value, expected);
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void expect_position(const shape *s, double x, double y, double z, double u, double v) {
    const double direction[3] = {x, y, z};
    double position[2];
    scenes_environment_position(s->layout, s->width, s->height, direction, position);
    assert_near(position[0] / s->width, u, 1e-12);
    assert_near(position[1] / s->height, v, 1e-12);
}

// The axes of each layout, written out from the documentation.
static void axes_lie_where_the_documentation_says(void **state) {
    (void)state;
    const shape latitude_longitude = {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 10, 5};
    expect_position(&latitude_longitude, 0, 0, 2, 0.5, 0.5);
    expect_position(&latitude_longitude, 3, 0, 0, 0.25, 0.5);
    expect_position(&latitude_longitude, -3, 0, 0, 0.75, 0.5);
    expect_position(&latitude_longitude, 1e-30, 0, -1, 0, 0.5);
    expect_position(&latitude_longitude, -1e-30, 0, -1, 1, 0.5);
    expect_position(&latitude_longitude, 0, 1, 0, 0.5, 0);
    expect_position(&latitude_longitude, 0, -1, 0, 0.5, 1);
    const shape column = {LOBE_ENVIRONMENT_CUBE_COLUMN, 4, 24};
    const shape row = {LOBE_ENVIRONMENT_CUBE_ROW, 24, 4};
    const shape vertical = {LOBE_ENVIRONMENT_VERTICAL_CROSS, 3, 4};
    const shape horizontal = {LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 4, 3};
    const double upright[6][2] = {{.5, 1.5}, {2.5, 1.5}, {1.5, .5}, {1.5, 2.5}, {1.5, 1.5}};
    for (int i = 0; i < 6; i++) {
        double d[3] = {0, 0, 0};
        d[i / 2] = i % 2 ? -5 : 5;
        expect_position(&column, d[0], d[1], d[2], 0.5, (i + 0.5) / 6);
        expect_position(&row, d[0], d[1], d[2], (i + 0.5) / 6, 0.5);
        const double *place = upright[i];
        expect_position(&vertical, d[0], d[1], d[2], i == 5 ? 0.5 : place[0] / 3,
                        i == 5 ? 3.5 / 4 : place[1] / 4);
        expect_position(&horizontal, d[0], d[1], d[2], i == 5 ? 3.5 / 4 : place[0] / 4,
                        i == 5 ? 0.5 : place[1] / 3);
    }
}

// Points off the middle of each face, as OpenEXR 3.1's own functions (ImfEnvmap.h) place them on a
// map of 101 x 606 texels: (3, 1, 2)/3 and the like, converted from texel centres to a fraction of
// the face.
static void columns_are_oriented_as_openexr_does(void **state) {
    (void)state;
    const struct {
        double direction[3], right, down;
    } expected[6] = {
        {{3, 1, 2}, 2.0 / 3, -1.0 / 3},  {{-3, 1, 2}, -2.0 / 3, -1.0 / 3},
        {{1, 3, 2}, 1.0 / 3, -2.0 / 3},  {{1, -3, 2}, 1.0 / 3, 2.0 / 3},
        {{1, 2, 3}, -1.0 / 3, -2.0 / 3}, {{1, 2, -3}, 1.0 / 3, -2.0 / 3},
    };
    for (int i = 0; i < 6; i++) {
        double position[2];
        scenes_environment_position(LOBE_ENVIRONMENT_CUBE_COLUMN, 100, 600, expected[i].direction,
                                    position);
        assert_near(position[0], 50 + 50 * expected[i].right, 1e-10);
        assert_near(position[1], 100 * i + 50 + 50 * expected[i].down, 1e-10);
    }
}

static void faces_are_right_handed_and_not_mirrored(void **state) {
    (void)state;
    for (int i = 3; i < SHAPE_COUNT; i++) {
        const environment_face *faces = scenes_environment_faces(shapes[i].layout);
        for (int f = 0; f < ENVIRONMENT_FACE_COUNT; f++) {
            double expected[3];
            cross(faces[f].down, faces[f].right, expected);
            // right = forward x up, up = -down.
            for (int axis = 0; axis < 3; axis++)
                assert_near(faces[f].forward[axis], -expected[axis], 0);
            assert_near(faces[f].forward[f / 2], f % 2 ? -1 : 1, 0);
        }
    }
}

static void position_and_direction_are_inverse(void **state) {
    (void)state;
    for (int i = 0; i < SHAPE_COUNT; i++) {
        const shape *s = &shapes[i];
        for (int k = 0; k < 4000; k++) {
            // Evenly spread directions (a spiral of the golden angle).
            const double y = 1 - (2 * k + 1) / 4000.0, r = sqrt(1 - y * y), angle = 2.399963 * k;
            const double direction[3] = {r * sin(angle), y, r * cos(angle)};
            double position[2], back[3];
            scenes_environment_position(s->layout, s->width, s->height, direction, position);
            assert_true(position[0] >= 0 && position[0] <= s->width);
            assert_true(position[1] >= 0 && position[1] <= s->height);
            assert_true(
                scenes_environment_direction(s->layout, s->width, s->height, position, back));
            assert_near(dot(direction, back), 1, 1e-13);
        }
    }
}

// Crossing an edge of a face on the picture of a cross is crossing the same edge of the cube.
static void crosses_fold_without_a_seam(void **state) {
    (void)state;
    for (int i = 5; i < 7; i++) {
        const shape *s = &shapes[i];
        uint32_t grid[2];
        scenes_environment_grid(s->layout, grid);
        const double size = (double)s->width / grid[0];
        int edges = 0;
        for (uint32_t line = 1; line < 4; line++) {
            for (double along = 0.25; along < 4 * size; along += 0.5) {
                for (int vertical = 0; vertical < 2; vertical++) {
                    const double before[2] = {vertical ? line * size - 1e-7 : along,
                                              vertical ? along : line * size - 1e-7};
                    const double after[2] = {vertical ? line * size + 1e-7 : along,
                                             vertical ? along : line * size + 1e-7};
                    double a[3], b[3];
                    if (!scenes_environment_direction(s->layout, s->width, s->height, before, a) ||
                        !scenes_environment_direction(s->layout, s->width, s->height, after, b))
                        continue;
                    assert_true(dot(a, b) > 1 - 1e-12);
                    edges++;
                }
            }
        }
        assert_int_equal(edges, 5 * 2 * (int)size); // five edges connect the six faces
    }
}

static void empty_parts_of_crosses_have_no_direction(void **state) {
    (void)state;
    for (int i = 5; i < 7; i++) {
        const shape *s = &shapes[i];
        uint32_t texels = 0;
        for (uint32_t y = 0; y < s->height; y++) {
            for (uint32_t x = 0; x < s->width; x++) {
                double direction[3];
                bool has = scenes_environment_direction(s->layout, s->width, s->height,
                                                        (double[2]){x + 0.5, y + 0.5}, direction);
                double angle = scenes_environment_solid_angle(s->layout, s->width, s->height, x, y,
                                                              x + 1.0, y + 1.0);
                assert_true(has == (angle > 0));
                texels += has;
            }
        }
        assert_int_equal(texels, s->width * s->height / 2);
    }
}

static void positions_outside_have_no_direction(void **state) {
    (void)state;
    for (int i = 0; i < SHAPE_COUNT; i++) {
        const shape *s = &shapes[i];
        const double outside[][2] = {
            {-0.01, 0.5}, {0.5, -0.01}, {s->width + 0.01, 0.5}, {0.5, s->height + 0.01}, {NAN, 0}};
        double direction[3];
        for (size_t k = 0; k < sizeof outside / sizeof *outside; k++)
            assert_false(scenes_environment_direction(s->layout, s->width, s->height, outside[k],
                                                      direction));
    }
}

static void solid_angles_cover_the_sphere(void **state) {
    (void)state;
    for (int i = 0; i < SHAPE_COUNT; i++) {
        const shape *s = &shapes[i];
        double sum = 0;
        for (uint32_t y = 0; y < s->height; y++) {
            for (uint32_t x = 0; x < s->width; x++)
                sum += scenes_environment_solid_angle(s->layout, s->width, s->height, x, y, x + 1.0,
                                                      y + 1.0);
        }
        assert_near(sum, 4 * M_PI, 1e-12);
    }
}

// Compared with the area of the small spherical quadrilateral between the texel's corners.
static void a_small_solid_angle_is_that_of_its_corners(void **state) {
    (void)state;
    const shape s = {LOBE_ENVIRONMENT_CUBE_ROW, 6 * 512, 512};
    const shape t = {LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 2048, 1024};
    const shape *both[2] = {&s, &t};
    for (int i = 0; i < 2; i++) {
        const double x = 100, y = 37;
        double c[3][3], a[3], b[3], normal[3];
        const double corners[3][2] = {{x, y}, {x + 1, y}, {x, y + 1}};
        for (int k = 0; k < 3; k++)
            assert_true(scenes_environment_direction(both[i]->layout, both[i]->width,
                                                     both[i]->height, corners[k], c[k]));
        for (int axis = 0; axis < 3; axis++) {
            a[axis] = c[1][axis] - c[0][axis];
            b[axis] = c[2][axis] - c[0][axis];
        }
        cross(a, b, normal);
        const double angle = scenes_environment_solid_angle(both[i]->layout, both[i]->width,
                                                            both[i]->height, x, y, x + 1, y + 1);
        assert_near(angle / sqrt(dot(normal, normal)), 1, 0.02);
    }
}

static void only_whole_square_faces_fit(void **state) {
    (void)state;
    for (int i = 0; i < SHAPE_COUNT; i++)
        assert_true(
            scenes_environment_layout_fits(shapes[i].layout, shapes[i].width, shapes[i].height));
    assert_false(scenes_environment_layout_fits(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, 0, 1));
    assert_false(scenes_environment_layout_fits(LOBE_ENVIRONMENT_CUBE_COLUMN, 8, 47));
    assert_false(scenes_environment_layout_fits(LOBE_ENVIRONMENT_CUBE_ROW, 13, 2));
    assert_false(scenes_environment_layout_fits(LOBE_ENVIRONMENT_VERTICAL_CROSS, 4, 5));
    assert_false(scenes_environment_layout_fits(LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 3, 4));
    assert_false(scenes_environment_layout_fits(LOBE_ENVIRONMENT_HORIZONTAL_CROSS, 0, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_lie_where_the_documentation_says),
        cmocka_unit_test(columns_are_oriented_as_openexr_does),
        cmocka_unit_test(faces_are_right_handed_and_not_mirrored),
        cmocka_unit_test(position_and_direction_are_inverse),
        cmocka_unit_test(crosses_fold_without_a_seam),
        cmocka_unit_test(empty_parts_of_crosses_have_no_direction),
        cmocka_unit_test(positions_outside_have_no_direction),
        cmocka_unit_test(solid_angles_cover_the_sphere),
        cmocka_unit_test(a_small_solid_angle_is_that_of_its_corners),
        cmocka_unit_test(only_whole_square_faces_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
