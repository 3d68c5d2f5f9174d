// The reference: the mean of many samples converges to closed forms at the expected rate, and does
// not depend on how it is split into submissions.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/renderer/accumulation.h"
#include "passes/renderer/shading.h"
#include "passes/renderer/shadows/shadow_maps.h"
#include "passes/upload/scene_upload.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static picture_request reference_request(uint32_t width, uint32_t height, uint32_t samples) {
    return (picture_request){.filter = "reference",
                             .settings = {NULL},
                             .width = width,
                             .height = height,
                             .samples = samples};
}

/// A matt material: reflects albedo/pi of the incident light.
static lobe_material matt_material(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    for (int i = 0; i < 3; i++) {
        material.lobes[0].colour[i] = 0;
        material.base_colour[i] = 1;
    }
    return material;
}

/// A checkerboard of black and white squares, of one texel each, under a light from above that
/// makes white 1. A picture of width `pixels` shows `texels` texels of it, the first from `start`.
static lobe_scene *board_scene(double texels, double start) {
    enum { SIZE = 16 };
    lobe_scene *scene = scene_begin();
    lobe_image image = map_image(LOBE_FORMAT_RGBA8_UNORM, SIZE, SIZE);
    for (int i = 0; i < SIZE * SIZE; i++)
        memset((uint8_t *)image.texels + 4 * i, (i % SIZE + i / SIZE) % 2 ? 255 : 0, 4);
    lobe_material material = matt_material();
    material.base_colour_map = scene_add_map(scene, image);
    material.base_colour_map.nearest = true;
    material.base_colour_map.transform[0][0] = (float)(texels / SIZE);
    material.base_colour_map.transform[1][1] = (float)(texels / SIZE);
    material.base_colour_map.transform[0][2] = (float)(start / SIZE);
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0, 1, 0}, M_PI);
    scene_look_down(scene, 2);
    scene_end(scene);
    return scene;
}

/// A Lambert plane is albedo/pi times the cosine, whatever the number of samples.
static void a_matt_plane_is_exact(void **state) {
    fixture *f = *state;
    lobe_scene *scene = scene_begin();
    lobe_material material = matt_material();
    material.base_colour[0] = 0.25f;
    material.base_colour[1] = 0.5f;
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){3, 4, 0}, 2);
    scene_look_down(scene, 1);
    scene_end(scene);
    static const uint32_t samples[] = {1, 7, 64};
    for (int i = 0; i < 3; i++) {
        picture_request request = reference_request(4, 4, samples[i]);
        lobe_frame frame = draw_scene(f, scene, &request);
        for (uint32_t j = 0; j < 16; j++) {
            const float *pixel = pixel_at(&frame.radiance, j % 4, j / 4);
            static const double albedo[3] = {0.25, 0.5, 1};
            for (int k = 0; k < 3; k++)
                assert_true(fabs((double)pixel[k] - albedo[k] / M_PI * 0.8 * 2) < 2e-6);
            assert_true(pixel[3] == 1);
        }
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

/// Pixels of two by two squares are half white: exactly where the squares' edges coincide with
/// those of strata.
static void a_checkerboard_is_half_white(void **state) {
    lobe_scene *scene = board_scene(16, 0);
    picture_request request = reference_request(8, 8, 64);
    lobe_frame frame = draw_scene(*state, scene, &request);
    for (uint32_t i = 0; i < 64; i++)
        assert_true(fabs((double)pixel_at(&frame.radiance, i % 8, i / 8)[0] - 0.5) < 1e-6);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    // Edges elsewhere: off by no more than a stratum or two.
    scene = board_scene(16, 0.29);
    for (uint32_t samples = 16; samples <= 1024; samples *= 8) {
        request = reference_request(8, 8, samples);
        frame = draw_scene(*state, scene, &request);
        for (uint32_t i = 0; i < 64; i++)
            assert_true(fabs((double)pixel_at(&frame.radiance, i % 8, i / 8)[0] - 0.5) <
                        3.0 / samples);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

/// The edge of a square at 0.3 of a pixel: coverage and radiance are 0.3 of the square, the rest is
/// background.
static void edges_are_covered_in_part(void **state) {
    enum { SAMPLES = 256 };
    lobe_scene *scene = scene_begin();
    lobe_material material = matt_material();
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0, 1, 0}, M_PI);
    // Two pixels a metre: the square ends at 4 + 2 = 6 pixels, moved by 0.3.
    scene_look_down(scene, 4);
    scene->camera.eye[0] = scene->camera.target[0] = -0.15f;
    scene_end(scene);
    scene->background[0] = 0.5f;
    picture_request request = reference_request(8, 8, SAMPLES);
    lobe_frame frame = draw_scene(*state, scene, &request);
    const float *pixel = pixel_at(&frame.radiance, 6, 4);
    assert_true(fabs((double)pixel[3] - 0.3) < 2.0 / SAMPLES);
    assert_true(fabs((double)pixel[1] - 0.3) < 2.0 / SAMPLES);
    assert_true(fabs((double)pixel[0] - (0.3 + 0.7 * 0.5)) < 2.0 / SAMPLES);
    assert_true(pixel_at(&frame.radiance, 5, 4)[3] == 1);
    assert_true(pixel_at(&frame.radiance, 7, 4)[3] == 0);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Convergence

static void check_convergence(fixture *f, const char *name) {
    enum { WIDTH = 64, HEIGHT = 36 };
    lobe_scene *scene;
    assert_int_equal(lobe_scene_open(name, NULL, &scene), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    picture_request request = reference_request(WIDTH, HEIGHT, LOBE_MAXIMUM_SAMPLES);
    lobe_frame truth = draw(f, &request);
    double first = 0;
    for (uint32_t samples = 16; samples <= 1024; samples *= 4) {
        request = reference_request(WIDTH, HEIGHT, samples);
        lobe_frame frame = draw(f, &request);
        double error = relative_l2(&frame.radiance, &truth.radiance);
        if (samples == 16)
            first = error;
        // Fewer than 16 samples miss most highlights. From there on 1/sqrt(N), and a quarter more
        // for chance.
        double bound = 1.25 * first * sqrt(16.0 / samples);
        if (!(error > 0 && error <= bound))
            fail_msg("%s: error %g of %u samples is above %g", name, error, samples, bound);
        lobe_frame_free(&frame);
    }
    lobe_frame_free(&truth);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void the_error_falls_with_samples(void **state) {
    check_convergence(*state, "checkerboard");
    check_convergence(*state, "bumps");
}

// ---------------------------------------------------------------------------------------------
// Submissions

static void one_sample_is_the_direct_picture(void **state) {
    lobe_scene *scene = board_scene(5, 0.2);
    picture_request request = reference_request(8, 8, 1);
    lobe_frame one = draw_scene(*state, scene, &request);
    request.filter = "direct";
    lobe_frame direct = draw_scene(*state, scene, &request);
    assert_memory_equal(one.radiance.texels, direct.radiance.texels, 8 * 8 * 16);
    lobe_frame_free(&one);
    lobe_frame_free(&direct);
    lobe_scene_destroy(&scene);
}

/// All samples in one frame of a graph, as the renderer would take them without splitting.
static void sum_in_one_submission(fixture *f, const lobe_scene *scene, uint32_t extent,
                                  uint32_t samples, float *mean) {
    const lobe_filter *filter = filter_named("reference");
    lobe_settings settings;
    lobe_settings_default(filter, &settings);
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    environment_state state = {0};
    const environment_work environment = {.state = &state};
    filter_context context = {.graph = f->graph,
                              .device = lobe_device_describe(f->device),
                              .settings = &settings,
                              .filter = filter,
                              .scene = uploaded,
                              .view = {.camera = &scene->camera},
                              .host = &f->host};
    filtered_appearance appearance = {0};
    draw_list draws = {0};
    assert_true(passes_draw_list_create(&draws, scene->mesh_count, NULL) &&
                passes_draw_list_reserve(&draws, scene->instance_count, NULL));
    lobe_graph_begin(f->graph);
    passes_draw_list_begin(&draws, uploaded);
    passes_draw_list_add(&draws, uploaded, 0, &appearance, true);
    passes_draw_list_end(&draws, &context);
    shading_targets targets = passes_shading_targets_declare(f->graph, extent, extent, false);
    shading_light light = passes_shading_light_prepare(&context, &environment);
    light.shadows = passes_shadow_maps(&context, &draws, NULL);
    lobe_resource sum = lobe_graph_image(
        f->graph,
        &(lobe_image_description){
            .name = "sum", .format = LOBE_FORMAT_RGBA32_FLOAT, .width = extent, .height = extent});
    lobe_pass *clear = lobe_graph_add_pass(f->graph, LOBE_PASS_TRANSFER, "clear");
    sum = lobe_pass_fill(clear, sum, (lobe_range){0}, (float[4]){0});
    for (uint32_t i = 0; i < samples; i++) {
        shading_sample sample = {.number = i};
        passes_sample_position(i, samples, sample.position);
        passes_shading(&context, &draws, &light, &sample, NULL, NULL, &targets);
        sum = passes_accumulation(f->graph, targets.radiance, sum, extent, extent);
    }
    lobe_graph_read_back(f->graph, sum, (lobe_range){0});
    if (lobe_graph_execute(f->graph) != LOBE_OK)
        fail_msg("%s", f->error);
    const float *data = lobe_graph_data(f->graph, sum, NULL);
    for (uint32_t i = 0; i < extent * extent * 4; i++)
        mean[i] = data[i] / (float)samples;
    lobe_graph_begin(f->graph);
    passes_draw_list_destroy(&draws);
    passes_device_scene_destroy(&uploaded);
}

static void submissions_do_not_show(void **state) {
    enum { EXTENT = 16, SAMPLES = 50 };
    lobe_scene *scene = board_scene(21, 0.4);
    float mean[EXTENT * EXTENT * 4];
    picture_request request = reference_request(EXTENT, EXTENT, SAMPLES);
    lobe_frame frame = draw_scene(*state, scene, &request);
    assert_true(frame.submissions > 1 && frame.submissions <= SAMPLES);
    sum_in_one_submission(*state, scene, EXTENT, SAMPLES, mean);
    const float *texels = frame.radiance.texels;
    for (int i = 0; i < EXTENT * EXTENT * 4; i++)
        assert_true(fabs((double)texels[i] - (double)mean[i]) <= 2e-6);
    size_t shadings = 0;
    for (size_t i = 0; i < frame.pass_count; i++) {
        if (strcmp(frame.passes[i].name, "shading") == 0)
            shadings = frame.passes[i].count;
    }
    assert_int_equal(shadings, SAMPLES);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

static void the_same_number_gives_the_same_bits(void **state) {
    lobe_scene *scene = board_scene(21, 0.4);
    picture_request request = reference_request(16, 16, 37);
    lobe_frame first = draw_scene(*state, scene, &request);
    lobe_frame second = draw_scene(*state, scene, &request);
    assert_memory_equal(first.radiance.texels, second.radiance.texels, 16 * 16 * 16);
    lobe_frame_free(&first);
    lobe_frame_free(&second);
    lobe_scene_destroy(&scene);
}

/// The outputs besides radiance are those of the pixels' centres.
static void outputs_are_those_of_the_centre(void **state) {
    lobe_scene *scene = board_scene(5, 0.2);
    picture_request request = reference_request(8, 8, 12);
    lobe_frame without = draw_scene(*state, scene, &request);
    request.outputs = true;
    lobe_frame with = draw_scene(*state, scene, &request);
    assert_memory_equal(without.radiance.texels, with.radiance.texels, 8 * 8 * 16);
    request.filter = "direct";
    lobe_frame direct = draw_scene(*state, scene, &request);
    assert_memory_equal(direct.normal_depth.texels, with.normal_depth.texels, 8 * 8 * 16);
    assert_memory_equal(direct.lobes_level.texels, with.lobes_level.texels, 8 * 8 * 8);
    lobe_frame_free(&without);
    lobe_frame_free(&with);
    lobe_frame_free(&direct);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Progress

typedef struct progress_record {
    unsigned calls, stop_after;
    double last;
} progress_record;

static bool record_progress(void *user, double part) {
    progress_record *record = user;
    assert_true(part > record->last && part <= 1);
    record->last = part;
    return ++record->calls != record->stop_after;
}

static void progress_grows_to_one_and_may_stop(void **state) {
    fixture *f = *state;
    lobe_scene *scene = board_scene(5, 0.2);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    progress_record record = {0};
    lobe_render_parameters parameters = {.filter = filter_named("reference"),
                                         .width = 4,
                                         .height = 4,
                                         .reference.samples = 64,
                                         .aov = true,
                                         .host = {.progress = record_progress, .user = &record}};
    lobe_frame frame;
    assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
    assert_true(record.calls > 1 && record.last == 1);
    assert_non_null(frame.radiance.texels);
    lobe_frame_free(&frame);
    record = (progress_record){.stop_after = 2};
    assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
    assert_int_equal(record.calls, 2);
    assert_null(frame.radiance.texels);
    assert_null(frame.normal_depth.texels);
    assert_null(frame.passes);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void samples_have_a_limit(void **state) {
    fixture *f = *state;
    lobe_scene *scene = board_scene(5, 0.2);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_render_parameters parameters = {
        .filter = filter_named("reference"), .width = 2, .height = 2, .reference.samples = 4097};
    lobe_frame frame;
    fixture_forget_messages(f);
    lobe_result result = lobe_renderer_render(f->renderer, &parameters, &frame);
    assert_failure(f, result, LOBE_ERROR_INVALID_ARGUMENT, "4096");
    assert_null(frame.radiance.texels);
    parameters.reference.samples = LOBE_MAXIMUM_SAMPLES;
    assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
    assert_true(all_finite(&frame.radiance));
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_matt_plane_is_exact),
        cmocka_unit_test(a_checkerboard_is_half_white),
        cmocka_unit_test(edges_are_covered_in_part),
        cmocka_unit_test(the_error_falls_with_samples),
        cmocka_unit_test(one_sample_is_the_direct_picture),
        cmocka_unit_test(submissions_do_not_show),
        cmocka_unit_test(the_same_number_gives_the_same_bits),
        cmocka_unit_test(outputs_are_those_of_the_centre),
        cmocka_unit_test(progress_grows_to_one_and_may_stop),
        cmocka_unit_test(samples_have_a_limit),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
