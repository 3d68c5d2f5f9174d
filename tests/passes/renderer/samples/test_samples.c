// Several filtered samples in pixels that need them (knob samples): where they are taken, and that
// nothing else changes.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { SIZE = 24 };

static picture_request request_with(const char *filter, const char *first, const char *second) {
    return (picture_request){.filter = filter,
                             .settings = {first, second, NULL},
                             .width = SIZE,
                             .height = SIZE,
                             .samples = 64};
}

/// A glowing square, of one radiance, turned a little, on black. `height`: metres in the picture.
static lobe_scene *glowing_square(double height) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    for (int i = 0; i < 3; i++) {
        material.emissive[i] = 1;
        scene->background[i] = 0;
    }
    const float turned[16] = {0.96f, 0, 0.28f, 0, 0, 1, 0, 0, -0.28f, 0, 0.96f, 0, 0, 0, 0, 1};
    scene_add_square(scene, &material, 1, turned);
    scene_look_down(scene, height);
    scene_end(scene);
    return scene;
}

/// The same with a rough normal map, seen at a grazing angle under a sun.
static lobe_scene *grazing_square(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 60);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.3, 5));
    scene_add_square(scene, &material, 2, NULL);
    scene_add_sun(scene, (double[]){0.2, 1, 0.6}, 3);
    scene_look_from(scene, (double[]){0.3, 0.35, 1}, 2.6);
    scene->background[2] = 0.2f;
    scene_end(scene);
    return scene;
}

static lobe_frame draw_with(fixture *f, const char *filter, const char *first, const char *second) {
    const picture_request request = request_with(filter, first, second);
    return draw(f, &request);
}

static void open_scene(fixture *f, const lobe_scene *scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
}

static void close_scene(fixture *f, lobe_scene *scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

static void assert_same_picture(const lobe_image *a, const lobe_image *b) {
    assert_int_equal(a->width, b->width);
    assert_memory_equal(a->texels, b->texels, (size_t)a->width * a->height * 16);
}

// ---------------------------------------------------------------------------------------------
// Edges

/// Parts of eight, near the reference; alpha is the same part.
static void an_edge_covers_a_part_of_its_pixels(void **state) {
    fixture *f = *state;
    lobe_scene *scene = glowing_square(3);
    open_scene(f, scene);
    lobe_frame truth = draw_with(f, "reference", NULL, NULL);
    lobe_frame one = draw_with(f, "lobes", NULL, NULL);
    static const char *const settings[] = {"samples=8", "samples=auto"};
    const float inside = pixel_at(&one.radiance, SIZE / 2, SIZE / 2)[0];
    for (int i = 0; i < 2; i++) {
        lobe_frame many = draw_with(f, "lobes", settings[i], NULL);
        unsigned parts = 0;
        for (uint32_t n = 0; n < SIZE * SIZE; n++) {
            const float *pixel = pixel_at(&many.radiance, n % SIZE, n / SIZE);
            assert_true(pixel[3] * 8 == floorf(pixel[3] * 8));
            assert_float_equal(pixel[0], pixel[3] * inside, 1e-6);
            parts += pixel[3] > 0 && pixel[3] < 1;
        }
        assert_true(parts > 40);
        assert_true(relative_l2(&many.radiance, &truth.radiance) <
                    0.3 * relative_l2(&one.radiance, &truth.radiance));
        assert_true(largest_difference(&many.radiance, &truth.radiance) < 0.2 * inside);
        assert_int_equal(many.submissions, 1);
        lobe_frame_free(&many);
    }
    lobe_frame_free(&one);
    lobe_frame_free(&truth);
    close_scene(f, scene);
}

/// A pixel without further samples keeps the first, and one with them has those of a picture with
/// as many everywhere.
static void a_pixel_takes_one_sample_or_all(void **state) {
    fixture *f = *state;
    lobe_scene *scene = grazing_square();
    open_scene(f, scene);
    lobe_frame one = draw_with(f, "lobes", NULL, NULL);
    lobe_frame all = draw_with(f, "lobes", "samples=8", NULL);
    lobe_frame some = draw_with(f, "lobes", "samples=auto", NULL);
    lobe_frame counts = draw_with(f, "lobes", "samples=auto", "view=samples");
    unsigned chosen = 0;
    for (uint32_t n = 0; n < SIZE * SIZE; n++) {
        const uint32_t x = n % SIZE, y = n / SIZE;
        const float count = pixel_at(&counts.radiance, x, y)[1];
        assert_true(count == 1 || count == 8);
        chosen += count == 8;
        const lobe_image *source = count == 8 ? &all.radiance : &one.radiance;
        assert_memory_equal(pixel_at(&some.radiance, x, y), pixel_at(source, x, y), 16);
    }
    assert_true(chosen > 30 && chosen < SIZE * SIZE - 30);
    lobe_frame_free(&one);
    lobe_frame_free(&all);
    lobe_frame_free(&some);
    lobe_frame_free(&counts);
    close_scene(f, scene);
}

static void every_filter_gains(void **state) {
    fixture *f = *state;
    lobe_scene *scene = grazing_square();
    open_scene(f, scene);
    lobe_frame truth = draw_with(f, "reference", NULL, NULL);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        if (lobe_filter_supersamples(lobe_filter_get(i)))
            continue;
        lobe_frame one = draw_with(f, filter, NULL, NULL);
        lobe_frame some = draw_with(f, filter, "samples=auto", NULL);
        double before = relative_l2(&one.radiance, &truth.radiance);
        double after = relative_l2(&some.radiance, &truth.radiance);
        if (!(after < 0.9 * before))
            fail_msg("%s: error %g with one sample, %g with more", filter, before, after);
        lobe_frame_free(&one);
        lobe_frame_free(&some);
    }
    lobe_frame_free(&truth);
    close_scene(f, scene);
}

// ---------------------------------------------------------------------------------------------
// What does not change

static void a_picture_without_edges_takes_one_sample(void **state) {
    fixture *f = *state;
    lobe_scene *scene = glowing_square(1);
    open_scene(f, scene);
    lobe_frame one = draw_with(f, "moments", NULL, NULL);
    lobe_frame some = draw_with(f, "moments", "samples=auto", NULL);
    assert_same_picture(&some.radiance, &one.radiance);
    lobe_frame_free(&some);
    some = draw_with(f, "moments", "samples=auto", "view=samples");
    for (uint32_t n = 0; n < SIZE * SIZE; n++)
        assert_true(pixel_at(&some.radiance, n % SIZE, n / SIZE)[0] == 1);
    lobe_frame_free(&some);
    lobe_frame_free(&one);
    close_scene(f, scene);
}

static void fixed_numbers_are_taken_everywhere(void **state) {
    fixture *f = *state;
    static const char *const settings[] = {"samples=1", "samples=2", "samples=4", "samples=8"};
    lobe_scene *scene = glowing_square(3);
    open_scene(f, scene);
    for (int i = 0; i < 4; i++) {
        lobe_frame counts = draw_with(f, "mipmap", settings[i], "view=samples");
        for (uint32_t n = 0; n < SIZE * SIZE; n++)
            assert_true(pixel_at(&counts.radiance, n % SIZE, n / SIZE)[2] == (float)(1 << i));
        lobe_frame_free(&counts);
    }
    close_scene(f, scene);
}

/// No further pass, and no memory but the picture and its depth.
static void one_sample_costs_nothing(void **state) {
    fixture *f = *state;
    lobe_scene *scene = glowing_square(3);
    open_scene(f, scene);
    lobe_frame one = draw_with(f, "lobes", "samples=1", NULL);
    const lobe_graph_report *report = lobe_graph_describe(lobe_renderer_graph(f->renderer));
    assert_int_equal(report->pass_count, 1);
    const uint64_t bytes = report->transient_bytes_without_aliasing;
    lobe_frame_free(&one);
    lobe_frame some = draw_with(f, "lobes", "samples=auto", NULL);
    report = lobe_graph_describe(lobe_renderer_graph(f->renderer));
    assert_true(report->pass_count > 10);
    assert_true(report->transient_bytes_without_aliasing >= 2 * bytes);
    lobe_frame_free(&some);
    close_scene(f, scene);
}

/// Depth, normals, lobes and level are those of the first sample.
static void outputs_are_those_of_one_sample(void **state) {
    fixture *f = *state;
    lobe_scene *scene = grazing_square();
    open_scene(f, scene);
    picture_request request = request_with("moments", NULL, NULL);
    request.outputs = true;
    lobe_frame one = draw(f, &request);
    static const char *const settings[] = {"samples=4", "samples=auto"};
    for (int i = 0; i < 2; i++) {
        request.settings[0] = settings[i];
        lobe_frame many = draw(f, &request);
        assert_same_picture(&many.normal_depth, &one.normal_depth);
        assert_memory_equal(many.lobes_level.texels, one.lobes_level.texels, SIZE * SIZE * 8);
        assert_true(largest_difference(&many.radiance, &one.radiance) > 0.05);
        lobe_frame_free(&many);
    }
    lobe_frame_free(&one);
    close_scene(f, scene);
}

static void the_reference_ignores_them(void **state) {
    fixture *f = *state;
    lobe_scene *scene = grazing_square();
    open_scene(f, scene);
    lobe_frame plain = draw_with(f, "reference", NULL, NULL);
    lobe_frame asked = draw_with(f, "reference", "samples=8", NULL);
    assert_same_picture(&asked.radiance, &plain.radiance);
    assert_int_equal(asked.submissions, plain.submissions);
    lobe_frame_free(&plain);
    lobe_frame_free(&asked);
    close_scene(f, scene);
}

/// After another size, and again: the order of the list of pixels does not matter.
static void pictures_do_not_depend_on_those_before(void **state) {
    fixture *f = *state;
    lobe_scene *scene = grazing_square();
    open_scene(f, scene);
    lobe_frame first = draw_with(f, "lobes", "samples=auto", NULL);
    for (uint32_t i = 0; i < 3; i++) {
        picture_request other = request_with("lobes", "samples=auto", NULL);
        other.width = 70 - 20 * i;
        lobe_frame between = draw(f, &other);
        lobe_frame again = draw_with(f, "lobes", "samples=auto", NULL);
        assert_same_picture(&again.radiance, &first.radiance);
        lobe_frame_free(&between);
        lobe_frame_free(&again);
    }
    lobe_frame_free(&first);
    close_scene(f, scene);
}

/// What all samples see alike stays exactly the same: a visible environment, too.
static void equal_samples_have_themselves_as_mean(void **state) {
    fixture *f = *state;
    lobe_scene *scene = glowing_square(1000);
    scene_set_environment(scene, constant_map(8, 4, 0.25f, 0.5f, 0.75f));
    scene->environment_visible = true;
    open_scene(f, scene);
    picture_request request = {.filter = "mipmap",
                               .settings = {"samples=8", "env=mip", "env_size=16", NULL},
                               .width = SIZE,
                               .height = SIZE};
    lobe_frame many = draw(f, &request);
    request.settings[0] = "samples=1";
    lobe_frame one = draw(f, &request);
    for (uint32_t x = 0; x < SIZE; x++)
        assert_memory_equal(pixel_at(&many.radiance, x, 1), pixel_at(&one.radiance, x, 1), 16);
    lobe_frame_free(&many);
    lobe_frame_free(&one);
    close_scene(f, scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_edge_covers_a_part_of_its_pixels),
        cmocka_unit_test(a_pixel_takes_one_sample_or_all),
        cmocka_unit_test(every_filter_gains),
        cmocka_unit_test(a_picture_without_edges_takes_one_sample),
        cmocka_unit_test(fixed_numbers_are_taken_everywhere),
        cmocka_unit_test(one_sample_costs_nothing),
        cmocka_unit_test(outputs_are_those_of_one_sample),
        cmocka_unit_test(the_reference_ignores_them),
        cmocka_unit_test(pictures_do_not_depend_on_those_before),
        cmocka_unit_test(equal_samples_have_themselves_as_mean),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
