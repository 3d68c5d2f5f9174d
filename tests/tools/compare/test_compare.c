#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cjson/cJSON.h>
#include <lobe/colour.h>
#include <lobe/exr.h>
#include <lobe/png.h>

#include "tests/engine/support/temporary_folder.h"
#include "tests/tools/cli/captured_output.h"
#include "tools/cli/subcommand.h"

enum { WIDTH = 24, HEIGHT = 16 };

static temporary_folder folder;
static char reference[256], near_test[256], far_test[256], picture[256], missing[256];

static void name_file(char *path, const char *name) {
    snprintf(path, 256, "%s", temporary_folder_file(&folder, name));
}

static lobe_image make_image(uint32_t width, uint32_t height, float offset) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
                     LOBE_OK);
    for (size_t index = 0; index < (size_t)4 * width * height; index++)
        ((float *)image.texels)[index] = (float)(index % 11) * 0.25f + offset;
    return image;
}

static void write_exr(const char *path, lobe_image image) {
    const lobe_exr_layer layer = {.image = &image, .depth = LOBE_EXR_FLOAT};
    const lobe_exr_parameters parameters = {.layers = &layer, .layer_count = 1};
    assert_int_equal(lobe_exr_write(path, &parameters, NULL), LOBE_OK);
    lobe_image_free(&image);
}

static void write_png(const char *path, lobe_image image) {
    lobe_image encoded;
    assert_int_equal(lobe_display_encode(&image, NULL, NULL, &encoded), LOBE_OK);
    assert_int_equal(lobe_png_write(path, &encoded, NULL), LOBE_OK);
    lobe_image_free(&encoded);
    lobe_image_free(&image);
}

static int prepare(void **state) {
    (void)state;
    temporary_folder_create(&folder);
    name_file(reference, "reference.exr");
    name_file(near_test, "near.exr");
    name_file(far_test, "far.exr");
    name_file(picture, "picture.png");
    name_file(missing, "missing.exr");
    write_exr(reference, make_image(WIDTH, HEIGHT, 0.0f));
    write_exr(near_test, make_image(WIDTH, HEIGHT, 0.125f));
    write_exr(far_test, make_image(WIDTH, HEIGHT, 1.0f));
    return 0;
}

static int clean_up(void **state) {
    (void)state;
    temporary_folder_remove(&folder);
    return 0;
}

static captured_output captured;

#define RUN(...)                                                                                   \
    captured_output_run(&captured, compare_subcommand.run,                                         \
                        (const char *[]){"compare", __VA_ARGS__, NULL})

static void expect_success(void) {
    if (captured.status != 0)
        print_message("%s", captured.errors);
    assert_int_equal(captured.status, 0);
    assert_string_equal(captured.errors, "");
}

/// One line that contains all of the texts, and nothing on standard output.
static void expect_failure(int status, const char *const *texts) {
    assert_int_equal(captured.status, status);
    assert_string_equal(captured.output, "");
    assert_int_equal(captured_output_lines(captured.errors), 1);
    for (; *texts != NULL; texts++) {
        if (strstr(captured.errors, *texts) == NULL)
            fail_msg("no '%s' in '%s'", *texts, captured.errors);
    }
}

#define EXPECT_FAILURE(status, ...) expect_failure(status, (const char *[]){__VA_ARGS__, NULL})

// ---------------------------------------------------------------------------------------------

static void each_metric_has_a_line(void **state) {
    (void)state;
    RUN(near_test, reference);
    expect_success();
    assert_int_equal(captured_output_lines(captured.output), 7);
    double values[7];
    assert_int_equal(sscanf(captured.output,
                            "rmse %lf\nrelative_mse %lf\nrelative_l2 %lf\nrelative_l1 %lf\n"
                            "psnr %lf\nmean_ratio %lf\nflip %lf\n",
                            &values[0], &values[1], &values[2], &values[3], &values[4], &values[5],
                            &values[6]),
                     7);
    assert_true(fabs(values[0] - 0.125) < 1e-6);
    assert_true(fabs(values[4] - 20.0 * log10(2.5 / 0.125)) < 1e-3); // peak 2.5
    assert_true(values[5] > 0.0 && values[6] > 0.0);
}

static void an_image_equals_itself(void **state) {
    (void)state;
    RUN(reference, reference);
    expect_success();
    assert_string_equal(captured.output, "rmse 0\nrelative_mse 0\nrelative_l2 0\nrelative_l1 0\n"
                                         "psnr inf\nmean_ratio 1\nflip 0\n");
}

static void json_says_the_same(void **state) {
    (void)state;
    RUN("--json", near_test, reference);
    expect_success();
    cJSON *root = cJSON_Parse(captured.output);
    assert_non_null(root);
    assert_string_equal(cJSON_GetObjectItem(root, "test")->valuestring, near_test);
    assert_string_equal(cJSON_GetObjectItem(root, "reference")->valuestring, reference);
    assert_int_equal(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "size"), 0)->valueint, WIDTH);
    assert_int_equal(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "size"), 1)->valueint, HEIGHT);
    assert_true(cJSON_IsTrue(cJSON_GetObjectItem(root, "high_dynamic_range")));
    assert_true(fabs(cJSON_GetObjectItem(root, "rmse")->valuedouble - 0.125) < 1e-9);
    const char *const names[] = {"relative_mse", "relative_l2", "relative_l1", "psnr", "flip"};
    for (int index = 0; index < 5; index++)
        assert_true(cJSON_IsNumber(cJSON_GetObjectItem(root, names[index])));
    cJSON_Delete(root);
    RUN("--json", reference, reference);
    root = cJSON_Parse(captured.output);
    assert_true(cJSON_IsNull(cJSON_GetObjectItem(root, "psnr"))); // infinite
    cJSON_Delete(root);
}

static void several_tests_make_a_table(void **state) {
    (void)state;
    RUN(near_test, far_test, reference);
    expect_success();
    assert_int_equal(captured_output_lines(captured.output), 3);
    char name[256];
    double rmse;
    const char *line = strchr(captured.output, '\n') + 1;
    assert_int_equal(sscanf(line, "%255s %lf", name, &rmse), 2);
    assert_string_equal(name, near_test);
    assert_true(fabs(rmse - 0.125) < 1e-6);
    line = strchr(line, '\n') + 1;
    assert_int_equal(sscanf(line, "%255s %lf", name, &rmse), 2);
    assert_string_equal(name, far_test);
    assert_true(fabs(rmse - 1.0) < 1e-6);
    RUN("--json", near_test, far_test, reference);
    cJSON *root = cJSON_Parse(captured.output);
    assert_int_equal(cJSON_GetArraySize(root), 2);
    cJSON_Delete(root);
}

static void png_files_are_compared_as_shown(void **state) {
    (void)state;
    char first[256], second[256];
    name_file(first, "first.png");
    name_file(second, "second.png");
    write_png(first, make_image(WIDTH, HEIGHT, 0.0f));
    write_png(second, make_image(WIDTH, HEIGHT, 0.5f));
    RUN("--json", first, second);
    expect_success();
    cJSON *root = cJSON_Parse(captured.output);
    assert_true(cJSON_IsFalse(cJSON_GetObjectItem(root, "high_dynamic_range")));
    double rmse = cJSON_GetObjectItem(root, "rmse")->valuedouble;
    double psnr = cJSON_GetObjectItem(root, "psnr")->valuedouble;
    assert_true(rmse > 0.0 && rmse < 1.0);
    assert_true(fabs(psnr + 20.0 * log10(rmse)) < 1e-6); // peak 1
    cJSON_Delete(root);
    RUN(first, reference);
    EXPECT_FAILURE(1, first, reference);
}

static void read_picture(const char *path, lobe_image *image) {
    assert_int_equal(lobe_png_read(path, NULL, image), LOBE_OK);
}

static void the_difference_is_a_heat_map(void **state) {
    (void)state;
    RUN("--diff", picture, reference, reference);
    expect_success();
    lobe_image image;
    uint8_t none[3];
    lobe_heat_colour(0.0f, none);
    read_picture(picture, &image);
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    for (int index = 0; index < WIDTH * HEIGHT; index++)
        assert_memory_equal((uint8_t *)image.texels + 4 * index, none, 3);
    lobe_image_free(&image);
    RUN("--diff", picture, far_test, reference);
    read_picture(picture, &image);
    assert_true(((uint8_t *)image.texels)[0] > none[0]);
    lobe_image_free(&image);
}

static void images_are_shown_side_by_side(void **state) {
    (void)state;
    RUN("--side-by-side", picture, near_test, far_test, reference);
    expect_success();
    lobe_image whole, part;
    read_picture(picture, &whole);
    assert_true(whole.width > 3 * WIDTH && whole.height > 2 * HEIGHT);
    RUN("--side-by-side", picture, "--crop", "4,2,8,6", "--zoom", "10", near_test, reference);
    expect_success();
    read_picture(picture, &part);
    assert_true(part.width > 2 * 80 && part.width < 2 * 80 + 40);
    lobe_image_free(&whole);
    lobe_image_free(&part);
}

// ---------------------------------------------------------------------------------------------

static void images_of_other_sizes_are_refused(void **state) {
    (void)state;
    write_exr(near_test, make_image(7, 5, 0.0f));
    RUN(near_test, reference);
    EXPECT_FAILURE(1, near_test, "7x5", reference, "24x16");
}

static void values_that_are_not_finite_are_counted(void **state) {
    (void)state;
    lobe_image image = make_image(WIDTH, HEIGHT, 0.0f);
    ((float *)image.texels)[4 * (3 * WIDTH + 5)] = NAN;
    ((float *)image.texels)[4 * (9 * WIDTH) + 1] = INFINITY;
    write_exr(near_test, image);
    RUN("--diff", picture, near_test, reference);
    EXPECT_FAILURE(1, near_test, "2 of 384", "x 5, y 3");
    assert_int_equal(access(picture, F_OK), -1);
}

static void damaged_files_are_named(void **state) {
    (void)state;
    RUN(missing, reference);
    EXPECT_FAILURE(1, missing);
    RUN(reference, missing);
    EXPECT_FAILURE(1, missing);
    assert_int_equal(truncate(near_test, 700), 0);
    RUN(near_test, reference);
    EXPECT_FAILURE(1, near_test);
    RUN(folder.path, reference);
    EXPECT_FAILURE(1, folder.path);
}

static void outputs_that_cannot_be_written_are_named(void **state) {
    (void)state;
    char nowhere[300];
    snprintf(nowhere, sizeof nowhere, "%s/none/picture.png", folder.path);
    RUN("--diff", nowhere, near_test, reference);
    EXPECT_FAILURE(1, nowhere);
    RUN("--side-by-side", nowhere, near_test, reference);
    EXPECT_FAILURE(1, nowhere);
    RUN("--side-by-side", picture, "--crop", "20,0,8,8", near_test, reference);
    EXPECT_FAILURE(1, "20,0,8,8", "24x16");
    assert_int_equal(temporary_folder_count(&folder), 3);
}

static void wrong_usage_is_told_apart(void **state) {
    (void)state;
    RUN(near_test);
    EXPECT_FAILURE(2, "TEST... REFERENCE");
    RUN("--diff", picture, near_test, far_test, reference);
    EXPECT_FAILURE(2, "--diff");
    RUN("--crop", "1,2,3", near_test, reference);
    EXPECT_FAILURE(2, "--crop");
    RUN("--crop", "0,0,0,4", near_test, reference);
    EXPECT_FAILURE(2, "--crop");
    RUN("--crop", "0,0.5,4,4", near_test, reference);
    EXPECT_FAILURE(2, "--crop");
    RUN("--pixels-per-degree=0", near_test, reference);
    EXPECT_FAILURE(2, "--pixels-per-degree");
    RUN("--zoom=0", near_test, reference);
    EXPECT_FAILURE(2, "--zoom");
    RUN("--help");
    assert_int_equal(captured.status, 0);
    assert_non_null(strstr(captured.output, "--diff FILE.png"));
}

#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, prepare, clean_up)

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(each_metric_has_a_line),
        IN_A_FOLDER(an_image_equals_itself),
        IN_A_FOLDER(json_says_the_same),
        IN_A_FOLDER(several_tests_make_a_table),
        IN_A_FOLDER(png_files_are_compared_as_shown),
        IN_A_FOLDER(the_difference_is_a_heat_map),
        IN_A_FOLDER(images_are_shown_side_by_side),
        IN_A_FOLDER(images_of_other_sizes_are_refused),
        IN_A_FOLDER(values_that_are_not_finite_are_counted),
        IN_A_FOLDER(damaged_files_are_named),
        IN_A_FOLDER(outputs_that_cannot_be_written_are_named),
        IN_A_FOLDER(wrong_usage_is_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
