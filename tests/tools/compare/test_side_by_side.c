#include "tests/engine/support/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#include <lobe/colour.h>

#include "tests/engine/support/log_recorder.h"
#include "tools/compare/bitmap_font.h"
#include "tools/compare/side_by_side.h"

enum { WIDTH = 60, HEIGHT = 10 };

static lobe_image make_picture(uint32_t width, uint32_t height, uint8_t value) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_RGBA8_SRGB, width, height, NULL),
                     LOBE_OK);
    memset(image.texels, value, (size_t)4 * width * height);
    return image;
}

static lobe_image make_errors(uint32_t width, uint32_t height, float value) {
    lobe_image image;
    assert_int_equal(lobe_image_allocate(&image, LOBE_FORMAT_R32_FLOAT, width, height, NULL),
                     LOBE_OK);
    for (size_t index = 0; index < (size_t)width * height; index++)
        ((float *)image.texels)[index] = value;
    return image;
}

/// Counts the texels of a colour in a picture.
static size_t count_colour(const lobe_image *image, const uint8_t rgb[3]) {
    size_t count = 0;
    for (size_t index = 0; index < (size_t)image->width * image->height; index++)
        count += memcmp((const uint8_t *)image->texels + 4 * index, rgb, 3) == 0;
    return count;
}

static size_t count_grey(const lobe_image *image, uint8_t value) {
    return count_colour(image, (uint8_t[3]){value, value, value});
}

static void every_panel_is_there_whole(void **state) {
    (void)state;
    lobe_image a = make_picture(WIDTH, HEIGHT, 101), b = make_picture(WIDTH, HEIGHT, 102);
    lobe_image c = make_picture(WIDTH, HEIGHT, 103), errors = make_errors(WIDTH, HEIGHT, 0.25f);
    const side_by_side_panel panels[3] = {
        {.caption = "a", .picture = &a, .error_caption = "x", .errors = &errors},
        {.caption = "b", .picture = &b},
        {.caption = "c", .picture = &c, .errors = &errors},
    };
    uint8_t heat[3];
    lobe_heat_colour(0.5f, heat);
    for (uint32_t columns = 0; columns < 4; columns++) {
        for (uint32_t zoom = 1; zoom < 3; zoom++) {
            const side_by_side_parameters parameters = {columns, zoom, 2.0f};
            lobe_image picture;
            assert_int_equal(side_by_side_compose(panels, 3, &parameters, NULL, &picture), LOBE_OK);
            size_t area = (size_t)WIDTH * HEIGHT * zoom * zoom;
            assert_int_equal(count_grey(&picture, 101), area);
            assert_int_equal(count_grey(&picture, 102), area);
            assert_int_equal(count_grey(&picture, 103), area);
            assert_true(count_colour(&picture, heat) >= 2 * area);
            uint32_t across = columns == 0 ? 3 : columns;
            assert_true(picture.width > across * zoom * WIDTH);
            assert_true(picture.width < across * (zoom * WIDTH + 16) + 16);
            lobe_image_free(&picture);
        }
    }
    lobe_image_free(&a);
    lobe_image_free(&b);
    lobe_image_free(&c);
    lobe_image_free(&errors);
}

/// The dots of a text in a panel, which is all that is written there.
static size_t dots_written(const char *caption, const lobe_image *picture) {
    const side_by_side_panel panel = {.caption = caption, .picture = picture};
    lobe_image composed;
    assert_int_equal(side_by_side_compose(&panel, 1, NULL, NULL, &composed), LOBE_OK);
    const size_t count = count_grey(&composed, 235);
    assert_int_equal(count_grey(&composed, 101), picture->width * picture->height);
    lobe_image_free(&composed);
    return count / 4;
}

static size_t dots_of(const char *text) {
    size_t count = 0;
    for (; *text != '\0'; text++)
        for (int n = 0; n < BITMAP_FONT_WIDTH * BITMAP_FONT_HEIGHT; n++)
            count += bitmap_font_dot(*text, n % BITMAP_FONT_WIDTH, n / BITMAP_FONT_WIDTH);
    return count;
}

static void captions_are_written_whole(void **state) {
    (void)state;
    static const char *const captions[] = {
        "",
        "lobes",
        "flip 0.123, rel. L2 0.123",
        "tablecloth.moments.normal_mapping-microfacet",
        "a picture with a long name, of words and more than one line",
        "a, picture of four lines if the first is not left alone with its letter"};
    lobe_image picture = make_picture(256, HEIGHT, 101);
    for (size_t n = 0; n < sizeof captions / sizeof *captions; n++)
        assert_int_equal(dots_written(captions[n], &picture), dots_of(captions[n]));
    lobe_image_free(&picture);
}

/// Nothing is written beside a panel, however narrow it is.
static void captions_of_narrow_panels_are_cut_off(void **state) {
    (void)state;
    const char *caption = "a caption that is far too long for its panel";
    for (uint32_t width = 1; width <= WIDTH; width++) {
        lobe_image picture = make_picture(width, HEIGHT, 101);
        const size_t dots = dots_written(caption, &picture);
        assert_true(dots < dots_of(caption) && (dots > 0) == (width >= 18));
        lobe_image_free(&picture);
    }
}

static void refuse(const side_by_side_panel *panels, size_t count, lobe_result expected) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image picture;
    const side_by_side_parameters parameters = {.zoom = expected == LOBE_ERROR_LIMIT ? 5000 : 1};
    assert_int_equal(side_by_side_compose(panels, count, &parameters, &recorder.host, &picture),
                     expected);
    assert_int_equal(recorder.errors, 1);
    assert_null(picture.texels);
}

static void what_does_not_fit_is_refused(void **state) {
    (void)state;
    lobe_image a = make_picture(8, 8, 1), b = make_picture(8, 9, 2), errors = make_errors(9, 8, 0);
    lobe_image wrong = make_errors(8, 8, 0);
    refuse(NULL, 0, LOBE_ERROR_INVALID_ARGUMENT);
    refuse((side_by_side_panel[]){{.picture = &a}, {.picture = &b}}, 2,
           LOBE_ERROR_INVALID_ARGUMENT);
    refuse((side_by_side_panel[]){{.picture = &a, .errors = &errors}}, 1,
           LOBE_ERROR_INVALID_ARGUMENT);
    refuse((side_by_side_panel[]){{.picture = &a, .errors = &b}}, 1, LOBE_ERROR_INVALID_ARGUMENT);
    refuse((side_by_side_panel[]){{.picture = &wrong}}, 1, LOBE_ERROR_INVALID_ARGUMENT);
    refuse((side_by_side_panel[]){{.picture = &a}, {.picture = &a}}, 2, LOBE_ERROR_LIMIT);
    lobe_image_free(&a);
    lobe_image_free(&b);
    lobe_image_free(&errors);
    lobe_image_free(&wrong);
}

/// The dots of a character as one number.
static uint64_t shape(char character) {
    uint64_t dots = 0;
    for (int y = 0; y < BITMAP_FONT_HEIGHT; y++) {
        for (int x = 0; x < BITMAP_FONT_WIDTH; x++)
            dots = dots << 1 | bitmap_font_dot(character, x, y);
    }
    return dots;
}

static void characters_can_be_told_apart(void **state) {
    (void)state;
    const char *characters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,:%-+/()=_<>*";
    for (const char *left = characters; *left != '\0'; left++) {
        assert_true(shape(*left) != 0);
        for (const char *right = characters; right < left; right++)
            assert_true(shape(*left) != shape(*right));
    }
    assert_true(shape('q') == shape('Q'));
    assert_true(shape(' ') == 0 && shape('\x80') == 0 && shape('\xff') == 0);
    assert_false(bitmap_font_dot('E', -1, 0) || bitmap_font_dot('E', 5, 0));
    assert_false(bitmap_font_dot('E', 0, -1) || bitmap_font_dot('E', 0, 7));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_panel_is_there_whole),
        cmocka_unit_test(captions_are_written_whole),
        cmocka_unit_test(captions_of_narrow_panels_are_cut_off),
        cmocka_unit_test(what_does_not_fit_is_refused),
        cmocka_unit_test(characters_can_be_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
