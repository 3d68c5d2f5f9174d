// What cannot be in the picture is not made, and nothing that can be is missing.

#include "passes/displacement/displacement.h"

#include <math.h>
#include <string.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static uint32_t triangles(fixture *f, const lobe_scene *scene, uint32_t extent,
                          const char *spacing) {
    drawn_geometry g = displaced_geometry_of(f, scene, extent, spacing);
    const uint32_t count = g.triangle_count;
    assert_int_equal(g.words[PATCH_SPACING], 0);
    drawn_geometry_free(&g);
    return count;
}

static lobe_frame picture_of(fixture *f, const lobe_scene *scene, const char *spacing) {
    const picture_request request = {.filter = "direct",
                                     .settings = {"displacement=geometry", spacing},
                                     .width = 96,
                                     .height = 96,
                                     .outputs = true};
    return draw_scene(f, scene, &request);
}

static size_t covered_pixels(const lobe_frame *frame) {
    size_t count = 0;
    for (uint32_t i = 0; i < 96 * 96; i++)
        count += ((const float *)frame->radiance.texels)[4 * i + 3] > 0;
    return count;
}

// ---------------------------------------------------------------------------------------------
// The picture

enum { MAP = 256 };

/// A map that lies on all of a plane of 64 m once: level, but for a peak at (u, v).
static lobe_image peak(double u, double v, double width, double height) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, MAP, MAP);
    for (int i = 0; i < MAP * MAP; i++) {
        const double x = (i % MAP + 0.5) / MAP - u, y = (i / MAP + 0.5) / MAP - v;
        ((float *)image.texels)[4 * i] =
            (float)(height * exp(-(x * x + y * y) / (2 * width * width)));
    }
    return image;
}

/// A far peak does not let patches be drawn around the picture.
static void heights_count_where_they_are(void **state) {
    fixture *f = *state;
    lobe_scene *level = plane_with_heights(64, 1.0f / 64, peak(0.1, 0.1, 0.02, 0), 0.3f, 4);
    lobe_scene *far = plane_with_heights(64, 1.0f / 64, peak(0.1, 0.1, 0.02, 1), 0.3f, 4);
    const uint32_t expected = triangles(f, level, 48, "pixels_per_vertex=1"),
                   found = triangles(f, far, 48, "pixels_per_vertex=1");
    assert_true(expected > 300);
    if (found > 1.1 * expected)
        fail_msg("%u triangles, %u without the peak", found, expected);
    lobe_scene_destroy(&level);
    lobe_scene_destroy(&far);
}

/// The camera looks level at the upper half of a peak, whose foot is far below the picture.
static void peaks_lean_into_the_picture(void **state) {
    fixture *f = *state;
    lobe_scene *scene = plane_with_heights(64, 1.0f / 64, peak(0.5, 0.5, 0.08, 1), 0.3f, 4);
    scene->camera = (lobe_camera){.eye = {0, 17, 30},
                                  .target = {0, 17, 0},
                                  .up = {0, 1, 0},
                                  .orthographic_height = 20,
                                  .near_plane = 0.1f};
    lobe_frame frame = picture_of(f, scene, "pixels_per_vertex=3");
    // exp(-r^2/2 s^2) > (17 + y)/19.2 for y in [-10, 2.2]: the mean of 2 r over 20 m.
    double expected = 0;
    for (int i = 0; i < 96; i++) {
        const double y = 7 + 20 * (i + 0.5) / 96;
        if (y < 19.2)
            expected += 2 * 64 * 0.08 * sqrt(2 * log(19.2 / y)) * 96 / 20;
    }
    assert_float_equal((double)covered_pixels(&frame), expected, 0.08 * expected);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Backs

static lobe_scene *ball(double waves, float scale, bool double_sided, bool mirrored, bool flat) {
    lobe_scene *scene = scene_begin();
    lobe_image heights = map_image(LOBE_FORMAT_RGBA32_FLOAT, MAP, MAP);
    for (int i = 0; i < MAP * MAP; i++) {
        const double u = 2 * M_PI * (i % MAP + 0.5) / MAP, v = 2 * M_PI * (i / MAP + 0.5) / MAP;
        ((float *)heights.texels)[4 * i] = (float)(0.5 + 0.25 * (sin(waves * u) + sin(waves * v)));
    }
    lobe_material material = material_with_heights(scene, heights, scale);
    material.double_sided = double_sided;
    lobe_mesh mesh;
    assert_int_equal(scenes_shape_sphere(24, 48, 1, 1, NULL, &mesh), LOBE_OK);
    const float side = mirrored ? -1 : 1, height = flat ? 0.3f : 1;
    add_instance_of(scene, &mesh, &material,
                    (float[]){side, 0, 0, 0, 0, height, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    scene_add_sun(scene, (double[]){1, 2, 3}, 2);
    scene->camera = (lobe_camera){.eye = {0.4f, 0.7f, 2.6f},
                                  .target = {0, 0, 0},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.9f,
                                  .near_plane = 0.01f};
    scene->has_camera = true;
    scene_end(scene);
    return scene;
}

static const char coarse[] = "pixels_per_vertex=24";

/// Where what is seen is the front, the depths with and without its backs.
static void check_depths(fixture *f, const lobe_scene *one, const lobe_scene *both,
                         const char *spacing) {
    lobe_frame a = picture_of(f, one, spacing), b = picture_of(f, both, spacing);
    assert_true(covered_pixels(&b) > 500);
    assert_true(largest_difference(&a.normal_depth, &b.normal_depth) == 0);
    lobe_frame_free(&a);
    lobe_frame_free(&b);
}

static void backs_are_not_drawn(void **state) {
    fixture *f = *state;
    for (int i = 0; i < 4; i++) {
        lobe_scene *one = ball(4, 0.01f, false, i & 1, i & 2);
        lobe_scene *both = ball(4, 0.01f, true, i & 1, i & 2);
        const uint32_t fronts = triangles(f, one, 96, coarse), all = triangles(f, both, 96, coarse);
        assert_true(all > 500);
        if (i < 2 && fronts > 0.7 * all)
            fail_msg("%d: %u of %u triangles are drawn", i, fronts, all);
        assert_true(fronts <= all);
        check_depths(f, one, both, coarse);
        lobe_scene_destroy(&one);
        lobe_scene_destroy(&both);
    }
}

/// Steep slopes of what lies behind the outline are seen.
static void steep_backs_are_drawn(void **state) {
    fixture *f = *state;
    for (int i = 0; i < 4; i++) {
        lobe_scene *one = ball(i < 2 ? 12 : 40, i % 2 ? 0.02f : 0.05f, false, false, false);
        lobe_scene *both = ball(i < 2 ? 12 : 40, i % 2 ? 0.02f : 0.05f, true, false, false);
        check_depths(f, one, both, coarse);
        lobe_scene_destroy(&one);
        lobe_scene_destroy(&both);
    }
}

/// So steep that triangles may lean any way.
static void the_steepest_backs_are_drawn(void **state) {
    fixture *f = *state;
    lobe_scene *one = ball(12, 0.12f, false, false, false);
    lobe_scene *both = ball(12, 0.12f, true, false, false);
    check_depths(f, one, both, "pixels_per_vertex=4");
    lobe_scene_destroy(&one);
    lobe_scene_destroy(&both);
}

// ---------------------------------------------------------------------------------------------
// Numbers of triangles

/// As many as the picture has room for, however many texels the map has.
static void triangles_follow_the_pixels(void **state) {
    fixture *f = *state;
    double last = 0;
    for (uint32_t texels = 128; texels <= 512; texels *= 2) {
        lobe_scene *scene = plane_with_heights(8, 0.5f, random_heights(texels, texels), 0.02f, 6);
        const double few = triangles(f, scene, 256, "pixels_per_vertex=2"),
                     many = triangles(f, scene, 512, "pixels_per_vertex=2");
        if (fabs(many / few - 4) > 0.5)
            fail_msg("%u texels: %g triangles at 256 pixels, %g at 512", texels, few, many);
        if (last > 0 && fabs(many / last - 1) > 0.2)
            fail_msg("%u texels: %g triangles, %g with fewer texels", texels, many, last);
        last = many;
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heights_count_where_they_are),
        cmocka_unit_test(peaks_lean_into_the_picture),
        cmocka_unit_test(backs_are_not_drawn),
        cmocka_unit_test(steep_backs_are_drawn),
        cmocka_unit_test(the_steepest_backs_are_drawn),
        cmocka_unit_test(triangles_follow_the_pixels),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
