#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>

#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tools/sweep/results.h"

// ---------------------------------------------------------------------------------------------
// Results to write

static sweep_pass passes[] = {
    {"lobe_clustering", 12.5, 3, true, true, 1048576, 1.25},
    {"shading", 80.25, 1, false, false, 0, 0},
};
static sweep_setting coarse[] = {{"epsilon0", "0.5"}, {"base", "own"}};
static sweep_setting fine[] = {{"epsilon0", "0.9"}, {"base", "own"}};

static sweep_row rows[] = {
    {.scene = "cloth",
     .filter = "lobes",
     .settings = fine,
     .setting_count = 2,
     .rebuilt_ms = 93.5,
     .rebuilt_p95_ms = 99,
     .retained_ms = 80.5,
     .retained_p95_ms = 85.75,
     .building_ms = 12.5,
     .shading_ms = 80.25,
     .changed_ms = 95.5,
     .changed_wall_ms = 240,
     .changed_caller_cpu_ms = 120.5,
     .changed_process_cpu_ms = 239,
     .passes = passes,
     .pass_count = 2,
     .memory_bytes = 6000000001,
     .bytes_per_texel = 21.5,
     .error = {0.125, 0.25, 0.5, 0.0625, 33.5, 1.5, 0.75},
     .error_lobe_base = {.psnr = INFINITY},
     .inside_relative_l2 = 0.375,
     .silhouettes_relative_l2 = 0.625,
     .flicker = 0.0078125,
     .picture = "a.pictures/cloth-lobes.exr"},
    {.scene = "cloth",
     .filter = "lobes",
     .settings = coarse,
     .setting_count = 2,
     .varied = "epsilon0",
     .flicker = -1},
};
static sweep_supersampling steps[] = {{1, 0.8}, {2, 0.4}, {4, 0.1}};
static sweep_scene scenes[] = {
    {.name = "cloth",
     .triangles = 1234,
     .noise = 0.3,
     .supersampling = steps,
     .supersampling_count = 3,
     .reference = "a.pictures/cloth.exr"},
    {.name = "\"dragon\" in sun",
     .scene = "\"dragon\"",
     .environment = "a/sun.exr",
     .lighting = "no lights",
     .noise = NAN,
     .skipped = "no such file:\n\xc3\xa4"},
};
static const sweep_results written = {
    .version = "1.2.3",
    .device = "a device",
    .driver = "a driver",
    .device_type = "CPU",
    .size = {640, 360},
    .reference_samples = 256,
    .path_samples = 64,
    .stations = 12,
    .frames = 20,
    .complete = true,
    .scenes = scenes,
    .scene_count = 2,
    .rows = rows,
    .row_count = 2,
};

static const char *results_file(void) {
    return temporary_folder_file(&test_folder, "results.json");
}

static void write_results(void) {
    assert_int_equal(sweep_results_write(results_file(), &written, NULL), LOBE_OK);
}

/// Valid until the next call.
static char *file_content(void) {
    static char content[16384];
    FILE *file = fopen(results_file(), "rb");
    assert_non_null(file);
    size_t size = fread(content, 1, sizeof content - 1, file);
    fclose(file);
    content[size] = '\0';
    return content;
}

/// The written file, with one piece of its text replaced.
static void write_changed(const char *piece, const char *by) {
    write_results();
    char *text = file_content(), *changed = NULL;
    char *found = strstr(text, piece);
    assert_non_null(found);
    *found = '\0';
    assert_true(asprintf(&changed, "%s%s%s", text, by, found + strlen(piece)) > 0);
    assert_int_equal(lobe_file_write(results_file(), changed, strlen(changed), NULL), LOBE_OK);
    free(changed);
}

/// Reading fails, with one message that contains the words and the file's name.
static void assert_refused(lobe_result expected, const char *words) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    sweep_results results = {.frames = 7};
    assert_int_equal(sweep_results_read(results_file(), &recorder.host, &results), expected);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, words));
    assert_non_null(strstr(recorder.last_error, "results.json"));
    assert_int_equal(results.frames, 0);
    assert_null(results.rows);
}

// ---------------------------------------------------------------------------------------------
// Cases

static void assert_errors_equal(const error_metrics *a, const error_metrics *b) {
    for (int i = 0; i < ERROR_METRICS_COUNT; i++) {
        double value = error_metrics_value(a, i), expected = error_metrics_value(b, i);
        assert_true(isfinite(expected) ? value == expected : isnan(value));
    }
}

static void assert_texts_equal(const char *a, const char *b) {
    assert_int_equal(a == NULL, b == NULL);
    if (b)
        assert_string_equal(a, b);
}

static void assert_rows_equal(const sweep_row *a, const sweep_row *b) {
    assert_string_equal(a->scene, b->scene);
    assert_string_equal(a->filter, b->filter);
    assert_int_equal(a->setting_count, b->setting_count);
    for (size_t i = 0; i < b->setting_count; i++) {
        assert_string_equal(a->settings[i].name, b->settings[i].name);
        assert_string_equal(a->settings[i].value, b->settings[i].value);
    }
    assert_string_equal(a->varied, b->varied);
    assert_true(a->rebuilt_ms == b->rebuilt_ms && a->rebuilt_p95_ms == b->rebuilt_p95_ms);
    assert_true(a->changed_ms == b->changed_ms && a->changed_wall_ms == b->changed_wall_ms);
    assert_true(a->changed_caller_cpu_ms == b->changed_caller_cpu_ms &&
                a->changed_process_cpu_ms == b->changed_process_cpu_ms);
    assert_true(a->retained_ms == b->retained_ms && a->retained_p95_ms == b->retained_p95_ms);
    assert_true(a->building_ms == b->building_ms && a->shading_ms == b->shading_ms);
    assert_true(a->memory_bytes == b->memory_bytes && a->bytes_per_texel == b->bytes_per_texel);
    assert_errors_equal(&a->error, &b->error);
    assert_errors_equal(&a->error_lobe_base, &b->error_lobe_base);
    assert_true(a->inside_relative_l2 == b->inside_relative_l2 &&
                a->silhouettes_relative_l2 == b->silhouettes_relative_l2);
    assert_true(a->flicker == b->flicker);
    assert_texts_equal(a->picture, b->picture);
}

static void assert_passes_equal(const sweep_row *a, const sweep_row *b) {
    assert_int_equal(a->pass_count, b->pass_count);
    for (size_t i = 0; i < b->pass_count; i++) {
        const sweep_pass *pass = &a->passes[i], *expected = &b->passes[i];
        assert_string_equal(pass->name, expected->name);
        assert_true(pass->milliseconds == expected->milliseconds && pass->count == expected->count);
        assert_true(pass->building == expected->building && pass->once == expected->once);
        assert_true(pass->bytes == expected->bytes);
        assert_true(pass->copy_milliseconds == expected->copy_milliseconds);
    }
}

static void everything_comes_back(void **state) {
    (void)state;
    write_results();
    sweep_results read;
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_string_equal(read.version, "1.2.3");
    assert_string_equal(read.device, "a device");
    assert_string_equal(read.driver, "a driver");
    assert_string_equal(read.device_type, "CPU");
    assert_true(read.size[0] == 640 && read.size[1] == 360);
    assert_int_equal(read.reference_samples, 256);
    assert_int_equal(read.path_samples, 64);
    assert_int_equal(read.stations, 12);
    assert_int_equal(read.frames, 20);
    assert_true(read.complete);
    assert_int_equal(read.scene_count, 2);
    for (size_t i = 0; i < 2; i++) {
        assert_string_equal(read.scenes[i].name, scenes[i].name);
        assert_texts_equal(read.scenes[i].scene, scenes[i].scene);
        assert_texts_equal(read.scenes[i].environment, scenes[i].environment);
        assert_texts_equal(read.scenes[i].lighting, scenes[i].lighting);
        assert_int_equal(read.scenes[i].triangles, scenes[i].triangles);
        assert_int_equal(isnan(read.scenes[i].noise), isnan(scenes[i].noise));
        assert_int_equal(read.scenes[i].supersampling_count, scenes[i].supersampling_count);
        for (size_t k = 0; k < scenes[i].supersampling_count; k++) {
            assert_int_equal(read.scenes[i].supersampling[k].samples, steps[k].samples);
            assert_true(read.scenes[i].supersampling[k].relative_l2 == steps[k].relative_l2);
        }
        assert_texts_equal(read.scenes[i].reference, scenes[i].reference);
        assert_texts_equal(read.scenes[i].skipped, scenes[i].skipped);
    }
    assert_int_equal(read.row_count, 2);
    for (size_t i = 0; i < 2; i++) {
        assert_rows_equal(&read.rows[i], &rows[i]);
        assert_passes_equal(&read.rows[i], &rows[i]);
    }
    sweep_results_free(&read);
    assert_null(read.rows);
}

static void what_is_not_finite_is_null(void **state) {
    (void)state;
    write_results();
    char *text = file_content();
    assert_null(strstr(text, "inf"));
    assert_null(strstr(text, "nan"));
    assert_non_null(strstr(text, "\"psnr\":\tnull"));
}

static void unknown_members_are_passed_over(void **state) {
    (void)state;
    write_changed("\"frames\"", "\"later\": {\"rows\": [1]}, \"frames\"");
    sweep_results read;
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_int_equal(read.row_count, 2);
    sweep_results_free(&read);
}

/// Files from before environments were supported.
static void what_older_files_lack_is_unknown(void **state) {
    (void)state;
    write_changed("\"environment\":\tnull", "\"envoy\":\tnull");
    sweep_results read;
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_null(read.scenes[0].environment);
    sweep_results_free(&read);
    write_changed("\"noise\"", "\"nose\"");
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_true(isnan(read.scenes[0].noise));
    sweep_results_free(&read);
    write_changed("\"supersampling\"", "\"sampling\"");
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_int_equal(read.scenes[0].supersampling_count, 0);
    sweep_results_free(&read);
    write_changed("\"changed_wall_ms\"", "\"changing_wall_ms\"");
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_true(isnan(read.rows[0].changed_wall_ms));
    sweep_results_free(&read);
    write_changed("\"mean_ratio\"", "\"ratio\"");
    assert_int_equal(sweep_results_read(results_file(), NULL, &read), LOBE_OK);
    assert_true(isnan(read.rows[0].error.mean_ratio));
    sweep_results_free(&read);
}

static void malformed_members_are_named(void **state) {
    (void)state;
    static const struct {
        const char *piece, *by, *named;
    } faults[] = {
        {"\"driver\"", "\"drive\"", "driver: missing"},
        {"\"a device\"", "5", "device: not a text"},
        {"[640, 360]", "[640]", "size: not a list of two"},
        {"[640, 360]", "[640, -1]", "size: not a whole number"},
        {"\"frames\":\t20", "\"frames\":\t2.5", "frames: not a whole number"},
        {"\"complete\":\ttrue", "\"complete\":\t1", "complete: neither true nor false"},
        {"\"triangles\":\t1234", "\"triangles\":\t1e300", "scenes[0].triangles: not a whole"},
        {"\"noise\":\t0.3", "\"noise\":\t\"0.3\"", "scenes[0].noise: neither a number nor null"},
        {"\"lighting\":\tnull", "\"lighting\":\t3", "scenes[0].lighting: not a text"},
        {"93.5", "\"93.5\"", "rows[0].rebuilt_ms: neither a number nor null"},
        {"80.25,\n\t\t\t\t\t\"count\":\t1", "80.25,\n\t\t\t\t\t\"count\":\t-1",
         "rows[0].passes[1].count: not a whole number"},
        {"\"flip\":\t0.75", "\"flap\":\t0.75", "rows[0].error.flip: missing"},
        {"\"value\":\t\"0.5\"", "\"value\":\t\"0.5000000000000000000000000000000\"",
         "rows[1].settings[0].value: text too long"},
        {"\"picture\":\tnull", "\"picture\":\t3", "rows[1].picture: not a text"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        write_changed(faults[i].piece, faults[i].by);
        assert_refused(LOBE_ERROR_MALFORMED, faults[i].named);
    }
}

static void other_lists_and_objects_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *named;
    } faults[] = {
        {"[]", "the whole file: not an object"}, {"{}", "version: missing"}, {"", "not JSON"}};
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        const char *text = faults[i].text;
        assert_int_equal(lobe_file_write(results_file(), text, strlen(text), NULL), LOBE_OK);
        assert_refused(LOBE_ERROR_MALFORMED, faults[i].named);
    }
}

static void cut_off_files_are_refused(void **state) {
    (void)state;
    write_results();
    char *text = file_content();
    size_t size = strlen(text);
    for (size_t length = 1; length < size; length += 97) {
        assert_int_equal(lobe_file_write(results_file(), text, length, NULL), LOBE_OK);
        assert_refused(LOBE_ERROR_MALFORMED, "cut off");
    }
}

static void missing_files_are_not_found(void **state) {
    (void)state;
    assert_refused(LOBE_ERROR_NOT_FOUND, "results.json");
}

static void a_folder_that_is_not_there_takes_no_file(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "none/results.json");
    assert_int_equal(sweep_results_write(path, &written, NULL), LOBE_ERROR_WRITE);
    assert_int_equal(temporary_folder_count(&test_folder), 0);
}

static void rows_are_found(void **state) {
    (void)state;
    static const sweep_setting swapped[] = {{"base", "own"}, {"epsilon0", "0.5"}};
    static const sweep_setting others[] = {{"base", "own"}, {"epsilon0", "0.6"}};
    assert_ptr_equal(sweep_results_row(&written, "cloth", "lobes", swapped, 2), &rows[1]);
    assert_null(sweep_results_row(&written, "cloth", "lobes", others, 2));
    assert_null(sweep_results_row(&written, "cloth", "lobes", swapped, 1));
    assert_ptr_equal(sweep_results_scene(&written, "cloth"), &scenes[0]);
    assert_null(sweep_results_scene(&written, "clot"));
}

static void scenes_are_told_apart_by_their_light(void **state) {
    (void)state;
    assert_true(sweep_scene_is(&scenes[0], "cloth", NULL, ""));
    assert_true(sweep_scene_is(&scenes[1], "\"dragon\"", "a/sun.exr", "no lights"));
    assert_false(sweep_scene_is(&scenes[1], "\"dragon\" in sun", "a/sun.exr", "no lights"));
    assert_false(sweep_scene_is(&scenes[1], "\"dragon\"", "b/sun.exr", "no lights"));
    assert_false(sweep_scene_is(&scenes[1], "\"dragon\"", NULL, "no lights"));
    assert_false(sweep_scene_is(&scenes[1], "\"dragon\"", "a/sun.exr", NULL));
    assert_false(sweep_scene_is(&scenes[0], "cloth", "a/sun.exr", ""));
}

static void noise_is_left_out_of_errors(void **state) {
    (void)state;
    assert_float_equal(sweep_error_without_noise(&scenes[0], &rows[0]), 0.4, 1e-12);
    assert_float_equal(sweep_error_without_noise(&scenes[0], &rows[1]), 0, 0);
    assert_float_equal(sweep_error_without_noise(&scenes[1], &rows[0]), 0.5, 0);
}

static void knobs_have_values(void **state) {
    (void)state;
    assert_string_equal(sweep_row_value(&rows[1], "epsilon0"), "0.5");
    assert_null(sweep_row_value(&rows[1], "epsilon"));
}

/// Interpolated on straight lines of logarithms, beyond the first number as noise falls.
static void rows_are_worth_samples(void **state) {
    (void)state;
    const sweep_scene scene = {
        .name = "a", .noise = NAN, .supersampling = steps, .supersampling_count = 3};
    static const double worths[][2] = {{1.6, 0.25}, {0.8, 1},  {0.4, 2},
                                       {0.1, 4},    {0.01, 4}, {0, 4}};
    for (size_t i = 0; i < sizeof worths / sizeof *worths; i++) {
        const sweep_row row = {.error.relative_l2 = worths[i][0]};
        assert_true(fabs(sweep_worth_in_samples(&scene, &row) - worths[i][1]) < 1e-12);
    }
    const sweep_row between = {.error.relative_l2 = 0.2};
    assert_true(fabs(sweep_worth_in_samples(&scene, &between) - sqrt(8)) < 1e-12);
    const sweep_scene unknown = {.name = "a", .noise = NAN};
    assert_true(isnan(sweep_worth_in_samples(&unknown, &between)));
}

/// The reference's row takes 64 samples.
static void gain_is_the_time_of_those_samples(void **state) {
    (void)state;
    sweep_scene scene = {
        .name = "a", .noise = NAN, .supersampling = steps, .supersampling_count = 3};
    sweep_row measured[] = {
        {.scene = "a", .filter = "lobes", .retained_ms = 4, .error.relative_l2 = 0.1},
        {.scene = "b", .filter = "reference", .retained_ms = 1},
        {.scene = "a", .filter = "reference", .retained_ms = 128},
    };
    sweep_results results = {.scenes = &scene, .scene_count = 1, .rows = measured, .row_count = 3};
    assert_true(sweep_gain_in_time(&results, &scene, &measured[0]) == 4 * 2.0 / 4);
    results.row_count = 2;
    assert_true(isnan(sweep_gain_in_time(&results, &scene, &measured[0])));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(everything_comes_back),
        IN_TEST_FOLDER(what_is_not_finite_is_null),
        IN_TEST_FOLDER(unknown_members_are_passed_over),
        IN_TEST_FOLDER(malformed_members_are_named),
        IN_TEST_FOLDER(other_lists_and_objects_are_refused),
        IN_TEST_FOLDER(cut_off_files_are_refused),
        IN_TEST_FOLDER(missing_files_are_not_found),
        IN_TEST_FOLDER(a_folder_that_is_not_there_takes_no_file),
        cmocka_unit_test(rows_are_found),
        IN_TEST_FOLDER(what_older_files_lack_is_unknown),
        cmocka_unit_test(scenes_are_told_apart_by_their_light),
        cmocka_unit_test(noise_is_left_out_of_errors),
        cmocka_unit_test(rows_are_worth_samples),
        cmocka_unit_test(gain_is_the_time_of_those_samples),
        cmocka_unit_test(knobs_have_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
