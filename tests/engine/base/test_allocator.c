// The host's allocator: what lobe allocates and frees, and what happens if an allocation fails, in
// everything that needs no device.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#include <lobe/colour.h>
#include <lobe/exr.h>
#include <lobe/file.h>
#include <lobe/png.h>
#include <lobe/profile.h>

#include "tests/engine/support/counting_allocator.h"
#include "tests/engine/support/temporary_folder.h"

// ---------------------------------------------------------------------------------------------
// Blocks

static void expect_zeroes(const unsigned char *bytes, size_t count) {
    assert_int_equal((uintptr_t)bytes % 16, 0);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(bytes[i], 0);
}

static void check_blocks(const lobe_allocator *allocator) {
    unsigned char *bytes = lobe_allocate(allocator, 25, 4);
    expect_zeroes(bytes, 100);
    memset(bytes, 7, 100);
    bytes = lobe_reallocate(allocator, bytes, 1000, 1);
    assert_int_equal((uintptr_t)bytes % 16, 0);
    for (int i = 0; i < 100; i++)
        assert_int_equal(bytes[i], 7);
    bytes[999] = 1;
    bytes = lobe_reallocate(NULL, bytes, 3, 1);
    assert_int_equal(bytes[2], 7);
    lobe_release(bytes);
    bytes = lobe_reallocate(allocator, NULL, 3, 8);
    expect_zeroes(bytes, 24);
    lobe_release(bytes);
    void *nothing = lobe_allocate(allocator, 0, 8);
    assert_non_null(nothing);
    lobe_release(nothing);
    char *text = lobe_copy_text(allocator, "lobe");
    assert_string_equal(text, "lobe");
    lobe_release(text);
    lobe_release(NULL);
}

static void blocks_are_the_c_librarys(void **state) {
    (void)state;
    check_blocks(NULL);
}

static void blocks_are_the_hosts(void **state) {
    (void)state;
    counting_allocator counting;
    counting_allocator_start(&counting);
    check_blocks(&counting.allocator);
    assert_int_equal(counting.taken, 6);
    assert_nothing_left(&counting);
}

static void sizes_beyond_all_are_refused(void **state) {
    (void)state;
    counting_allocator counting;
    counting_allocator_start(&counting);
    const lobe_allocator *const allocators[] = {NULL, &counting.allocator};
    for (int i = 0; i < 2; i++) {
        assert_null(lobe_allocate(allocators[i], SIZE_MAX, 1));
        assert_null(lobe_allocate(allocators[i], SIZE_MAX / 4, 8));
        assert_null(lobe_allocate(allocators[i], SIZE_MAX - 8, 1));
        char *block = lobe_copy_text(allocators[i], "kept");
        assert_null(lobe_reallocate(allocators[i], block, SIZE_MAX / 2, 3));
        assert_string_equal(block, "kept");
        lobe_release(block);
    }
    assert_int_equal(counting.taken, 1);
    assert_nothing_left(&counting);
}

static void a_block_that_cannot_grow_is_kept(void **state) {
    (void)state;
    counting_allocator counting;
    counting_allocator_start(&counting);
    char *block = lobe_copy_text(&counting.allocator, "kept");
    counting.failing = 2;
    assert_null(lobe_reallocate(&counting.allocator, block, 100, 1));
    assert_string_equal(block, "kept");
    lobe_release(block);
    assert_nothing_left(&counting);
}

/// A block remembers its allocator, whichever allocator a reallocation names.
static void allocators_do_not_mix(void **state) {
    (void)state;
    counting_allocator countings[2];
    char *blocks[2];
    for (int i = 0; i < 2; i++) {
        counting_allocator_start(&countings[i]);
        blocks[i] = lobe_copy_text(&countings[i].allocator, "text");
    }
    for (int i = 0; i < 2; i++)
        blocks[i] = lobe_reallocate(&countings[1 - i].allocator, blocks[i], 50 + (size_t)i, 1);
    assert_int_equal(countings[1].bytes, countings[0].bytes + 1);
    for (int i = 0; i < 2; i++) {
        lobe_release(blocks[i]);
        assert_int_equal(countings[i].taken, 2);
        assert_nothing_left(&countings[i]);
    }
}

// ---------------------------------------------------------------------------------------------
// Images and files

static lobe_result make_image(lobe_format format, uint32_t width, uint32_t height,
                              const lobe_host *host, lobe_image *image) {
    lobe_result result = lobe_image_allocate(image, format, width, height, host);
    const size_t size = result ? 0 : (size_t)width * height * lobe_format_size(format);
    for (size_t i = 0; i < size; i++)
        ((uint8_t *)image->texels)[i] = (uint8_t)(i % 59);
    return result;
}

static lobe_result work_with_png(void *user, const lobe_host *host) {
    (void)user;
    const char *path = temporary_folder_file(&test_folder, "picture.png");
    lobe_image linear, picture = {0}, read = {0};
    uint8_t *data = NULL;
    size_t size;
    lobe_result result = make_image(LOBE_FORMAT_RGBA32_FLOAT, 30, 20, host, &linear);
    result = result ? result : lobe_display_encode(&linear, NULL, host, &picture);
    result = result ? result : lobe_png_write(path, &picture, host);
    result = result ? result : lobe_png_encode("data", &picture, host, &data, &size);
    result = result ? result : lobe_png_read(path, host, &read);
    lobe_release(data);
    lobe_image_free(&linear);
    lobe_image_free(&picture);
    lobe_image_free(&read);
    return result;
}

static lobe_result work_with_exr(void *user, const lobe_host *host) {
    const uint32_t level_count = *(const uint32_t *)user;
    const char *path = temporary_folder_file(&test_folder, "layers.exr");
    lobe_image levels[3] = {0}, read = {0};
    lobe_exr_contents contents = {0};
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; result == LOBE_OK && i < 3; i++)
        result = make_image(LOBE_FORMAT_RGBA16_FLOAT, 4u >> i, 4u >> i, host, &levels[i]);
    const lobe_exr_layer layers[2] = {{.image = levels}, {.name = "again", .image = levels}};
    const lobe_exr_attribute attribute = {.name = "maker", .type = LOBE_EXR_TEXT, .text = "us"};
    const lobe_exr_parameters parameters = {.layers = layers,
                                            .layer_count = 2,
                                            .attributes = &attribute,
                                            .attribute_count = 1,
                                            .level_count = level_count};
    result = result ? result : lobe_exr_write(path, &parameters, host);
    result = result ? result : lobe_exr_read(path, "again", host, &read);
    result = result ? result : lobe_exr_read_contents(path, NULL, host, &contents);
    for (int i = 0; i < 3; i++)
        lobe_image_free(&levels[i]);
    lobe_image_free(&read);
    lobe_exr_contents_free(&contents);
    return result;
}

/// A new file, and an old one.
static lobe_result work_with_files(void *user, const lobe_host *host) {
    (void)user;
    const char *path = temporary_folder_file(&test_folder, "file");
    uint8_t *data = NULL;
    size_t size;
    lobe_result result = lobe_file_write(path, "bytes", 5, host);
    result = result ? result : lobe_file_write(path, "bytes", 5, host);
    result = result ? result : lobe_file_read(path, NULL, host, &data, &size);
    lobe_release(data);
    return result;
}

static lobe_result work_with_profile(void *user, const lobe_host *host) {
    (void)user;
    const lobe_pass_report passes[] = {{.name = "a", .milliseconds = 1},
                                       {.name = "b", .milliseconds = 2}};
    const lobe_graph_report report = {.passes = passes, .pass_count = 2, .milliseconds = 3};
    lobe_profile *profile;
    lobe_profile_summary summary;
    lobe_result result = lobe_profile_create(host, &profile);
    for (int i = 0; result == LOBE_OK && i < 20; i++)
        result = lobe_profile_add(profile, &report);
    result = result ? result : lobe_profile_statistics(profile, &summary);
    lobe_profile_destroy(&profile);
    return result;
}

static void png_files_say_where_memory_ends(void **state) {
    (void)state;
    // libpng allocates there too, and so does zlib.
    assert_true(fail_each_allocation(work_with_png, NULL) > 20);
}

static void exr_files_say_where_memory_ends(void **state) {
    (void)state;
    uint32_t level_count = 1;
    assert_true(fail_each_allocation(work_with_exr, &level_count) > 12);
    level_count = 3;
    assert_true(fail_each_allocation(work_with_exr, &level_count) > 16);
}

static void files_say_where_memory_ends(void **state) {
    (void)state;
    assert_true(fail_each_allocation(work_with_files, NULL) >= 3);
    assert_int_equal(temporary_folder_count(&test_folder), 1);
}

static void profiles_say_where_memory_ends(void **state) {
    (void)state;
    assert_true(fail_each_allocation(work_with_profile, NULL) > 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_are_the_c_librarys),
        cmocka_unit_test(blocks_are_the_hosts),
        cmocka_unit_test(sizes_beyond_all_are_refused),
        cmocka_unit_test(a_block_that_cannot_grow_is_kept),
        cmocka_unit_test(allocators_do_not_mix),
        IN_TEST_FOLDER(png_files_say_where_memory_ends),
        IN_TEST_FOLDER(exr_files_say_where_memory_ends),
        IN_TEST_FOLDER(files_say_where_memory_ends),
        cmocka_unit_test(profiles_say_where_memory_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
