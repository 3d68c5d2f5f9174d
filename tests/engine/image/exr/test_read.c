#include "tests/engine/support/cmocka_all.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ImfCRgbaFile.h>

#include <lobe/exr.h>
#include <lobe/file.h>

#include "tests/engine/support/exr_fixture.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"

static const exr_fixture_channel bgr_half[3] = {
    {"B", EXR_PIXEL_HALF, 1}, {"G", EXR_PIXEL_HALF, 1}, {"R", EXR_PIXEL_HALF, 1}};

static exr_attr_box2i_t window(int left, int top, int right, int bottom) {
    exr_attr_box2i_t box = {.min = {.x = left, .y = top}, .max = {.x = right, .y = bottom}};
    return box;
}

static exr_fixture_part plain_part(int width, int height) {
    return (exr_fixture_part){
        .data_window = window(0, 0, width - 1, height - 1),
        .display_window = window(0, 0, width - 1, height - 1),
        .compression = EXR_COMPRESSION_ZIP,
        .channels = bgr_half,
        .channel_count = 3,
    };
}

static const float *texel(const lobe_image *image, int x, int y) {
    return (const float *)image->texels + 4 * ((size_t)y * image->width + (size_t)x);
}

/// Each component must hold the fixture's channel (-1: alpha without a channel).
static void expect_channels(const lobe_image *image, const exr_fixture_part *part,
                            const int channels[4]) {
    const exr_attr_box2i_t *data = &part->data_window, *display = &part->display_window;
    assert_int_equal(image->format, LOBE_FORMAT_RGBA32_FLOAT);
    assert_int_equal(image->width, display->max.x - display->min.x + 1);
    assert_int_equal(image->height, display->max.y - display->min.y + 1);
    for (int y = display->min.y; y <= display->max.y; y++) {
        for (int x = display->min.x; x <= display->max.x; x++) {
            bool covered =
                x >= data->min.x && x <= data->max.x && y >= data->min.y && y <= data->max.y;
            const float *found = texel(image, x - display->min.x, y - display->min.y);
            for (int component = 0; component < 4; component++) {
                float value =
                    channels[component] < 0 ? 1.0f : exr_fixture_value(channels[component], x, y);
                assert_true(found[component] == (covered ? value : 0.0f));
            }
        }
    }
}

static void expect_read(const exr_fixture_part *parts, int count, const char *layer,
                        const exr_fixture_part *chosen, const int channels[4]) {
    const char *path = temporary_folder_file(&test_folder, "fixture.exr");
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    exr_fixture_write(path, parts, count);
    lobe_result result = lobe_exr_read(path, layer, &recorder.host, &image);
    if (result != LOBE_OK)
        print_message("%s\n", recorder.last_error);
    assert_int_equal(result, LOBE_OK);
    assert_int_equal(recorder.errors, 0);
    expect_channels(&image, chosen, channels);
    lobe_image_free(&image);
}

static void expect_file_error(const char *path, const char *layer, lobe_result expected) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    assert_int_equal(lobe_exr_read(path, layer, &recorder.host, &image), expected);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, path));
    assert_null(strchr(recorder.last_error, '\n'));
    assert_null(image.texels);
}

// ---------------------------------------------------------------------------------------------

static const int rgb_of_bgr[4] = {2, 1, 0, -1};

static void every_lossless_compression_is_read(void **state) {
    (void)state;
    const exr_compression_t compressions[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                              EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                              EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24};
    for (size_t index = 0; index < sizeof compressions / sizeof compressions[0]; index++) {
        exr_fixture_part part = plain_part(67, 45);
        part.compression = compressions[index];
        expect_read(&part, 1, NULL, &part, rgb_of_bgr);
        part.tile_width = 16;
        part.tile_height = 24;
        expect_read(&part, 1, NULL, &part, rgb_of_bgr);
    }
}

static void lossy_compression_is_read_too(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "b44.exr");
    exr_fixture_part part = plain_part(40, 40);
    part.compression = EXR_COMPRESSION_B44;
    exr_fixture_write(path, &part, 1);
    lobe_image image;
    assert_int_equal(lobe_exr_read(path, NULL, NULL, &image), LOBE_OK);
    for (int y = 0; y < 40; y++) {
        for (int x = 0; x < 40; x++)
            assert_true(fabsf(texel(&image, x, y)[0] - exr_fixture_value(2, x, y)) < 16.0f);
    }
    lobe_image_free(&image);
}

/// Smooth, so that lossy compression is off by a few hundredths at most.
static float smooth_value(int channel, int x, int y) {
    return 1.0f + 0.5f * sinf(0.05f * (float)x * (float)(channel + 1)) +
           0.3f * cosf(0.07f * (float)y);
}

/// OpenEXRCore 3.1 cannot write DWAA and DWAB either; the C interface of the older library can.
static void write_dwa(const char *path, int compression, int channels, bool tiled) {
    enum { LEFT = -3, TOP = 5, WIDTH = 70, HEIGHT = 300 };
    ImfHeader *header = ImfNewHeader();
    ImfHeaderSetDataWindow(header, LEFT, TOP, LEFT + WIDTH - 1, TOP + HEIGHT - 1);
    ImfHeaderSetDisplayWindow(header, 0, 0, 63, 319);
    ImfHeaderSetCompression(header, compression);
    ImfRgba *texels = calloc((size_t)WIDTH * HEIGHT, sizeof *texels);
    for (int index = 0; index < WIDTH * HEIGHT; index++) {
        const int x = LEFT + index % WIDTH, y = TOP + index / WIDTH;
        ImfFloatToHalf(smooth_value(0, x, y), &texels[index].r);
        ImfFloatToHalf(smooth_value(channels == IMF_WRITE_Y ? 0 : 1, x, y), &texels[index].g);
        ImfFloatToHalf(smooth_value(channels == IMF_WRITE_Y ? 0 : 2, x, y), &texels[index].b);
        ImfFloatToHalf(smooth_value(3, x, y), &texels[index].a);
    }
    const ImfRgba *base = texels - LEFT - TOP * WIDTH;
    if (tiled) {
        ImfTiledOutputFile *file =
            ImfOpenTiledOutputFile(path, header, channels, 32, 32, IMF_ONE_LEVEL, IMF_ROUND_DOWN);
        assert_non_null(file);
        assert_true(ImfTiledOutputSetFrameBuffer(file, base, 1, WIDTH));
        assert_true(
            ImfTiledOutputWriteTiles(file, 0, (WIDTH - 1) / 32, 0, (HEIGHT - 1) / 32, 0, 0));
        assert_true(ImfCloseTiledOutputFile(file));
    } else {
        ImfOutputFile *file = ImfOpenOutputFile(path, header, channels);
        assert_non_null(file);
        assert_true(ImfOutputSetFrameBuffer(file, base, 1, WIDTH));
        assert_true(ImfOutputWritePixels(file, HEIGHT));
        assert_true(ImfCloseOutputFile(file));
    }
    free(texels);
    ImfDeleteHeader(header);
}

static void expect_smooth(const char *path, bool grey, bool alpha) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    lobe_result result = lobe_exr_read(path, NULL, &recorder.host, &image);
    if (result != LOBE_OK)
        print_message("%s\n", recorder.last_error);
    assert_int_equal(result, LOBE_OK);
    assert_int_equal(image.width, 64);
    assert_int_equal(image.height, 320);
    for (int y = 0; y < 320; y++) {
        for (int x = 0; x < 64; x++) {
            const bool covered = y >= 5 && y < 305;
            for (int channel = 0; channel < 4; channel++) {
                float value = smooth_value(grey && channel < 3 ? 0 : channel, x, y);
                if (channel == 3 && !alpha)
                    value = 1.0f;
                assert_true(fabsf(texel(&image, x, y)[channel] - (covered ? value : 0)) < 0.05f);
            }
        }
    }
    lobe_image_free(&image);
}

static void what_openexr_core_cannot_unpack_is_read(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "dwa.exr");
    const int compressions[2] = {IMF_DWAA_COMPRESSION, IMF_DWAB_COMPRESSION};
    for (int index = 0; index < 4; index++) {
        write_dwa(path, compressions[index % 2], IMF_WRITE_RGBA, index / 2);
        expect_smooth(path, false, true);
    }
    write_dwa(path, IMF_DWAA_COMPRESSION, IMF_WRITE_RGB, false);
    expect_smooth(path, false, false);
    write_dwa(path, IMF_DWAB_COMPRESSION, IMF_WRITE_Y, false);
    expect_smooth(path, true, false);
}

static void sizes_down_to_one_texel_are_read(void **state) {
    (void)state;
    const int sizes[][2] = {{1, 1}, {1, 33}, {100, 1}, {17, 16}, {3, 257}};
    for (size_t index = 0; index < sizeof sizes / sizeof sizes[0]; index++) {
        exr_fixture_part part = plain_part(sizes[index][0], sizes[index][1]);
        expect_read(&part, 1, NULL, &part, rgb_of_bgr);
        part.tile_width = part.tile_height = 8;
        expect_read(&part, 1, NULL, &part, rgb_of_bgr);
    }
}

static void the_finest_level_is_read(void **state) {
    (void)state;
    exr_fixture_part part = plain_part(45, 30);
    part.tile_width = part.tile_height = 16;
    part.mipmap = true;
    expect_read(&part, 1, NULL, &part, rgb_of_bgr);
}

static void all_channel_types_become_float(void **state) {
    (void)state;
    const exr_fixture_channel channels[4] = {{"A", EXR_PIXEL_HALF, 1},
                                             {"B", EXR_PIXEL_UINT, 1},
                                             {"G", EXR_PIXEL_FLOAT, 1},
                                             {"R", EXR_PIXEL_HALF, 1}};
    exr_fixture_part part = plain_part(21, 35);
    part.channels = channels;
    part.channel_count = 4;
    expect_read(&part, 1, NULL, &part, (int[4]){3, 2, 1, 0});
}

static void the_display_window_frames_the_image(void **state) {
    (void)state;
    exr_fixture_part part = plain_part(1, 1);
    part.display_window = window(0, 0, 30, 40);
    part.data_window =
        window(-5, 10, 20, 60); // beyond the display window on two sides, inside on the others
    expect_read(&part, 1, NULL, &part, rgb_of_bgr);
    part.tile_width = part.tile_height = 16;
    expect_read(&part, 1, NULL, &part, rgb_of_bgr);
    part.data_window = window(100, 100, 110, 110); // all outside the display window
    expect_read(&part, 1, NULL, &part, rgb_of_bgr);
    part.display_window = window(-7, -9, 5, 3);
    part.data_window = window(-7, -9, 5, 3);
    expect_read(&part, 1, NULL, &part, rgb_of_bgr);
}

static void layers_are_found_by_name(void **state) {
    (void)state;
    const exr_fixture_channel channels[8] = {
        {"B", EXR_PIXEL_HALF, 1},           {"G", EXR_PIXEL_HALF, 1},
        {"R", EXR_PIXEL_HALF, 1},           {"a.b.Y", EXR_PIXEL_FLOAT, 1},
        {"lobes.count", EXR_PIXEL_UINT, 1}, {"normal.X", EXR_PIXEL_FLOAT, 1},
        {"normal.Y", EXR_PIXEL_FLOAT, 1},   {"normal.Z", EXR_PIXEL_FLOAT, 1},
    };
    exr_fixture_part part = plain_part(19, 23);
    part.channels = channels;
    part.channel_count = 8;
    expect_read(&part, 1, NULL, &part, rgb_of_bgr);
    expect_read(&part, 1, "a.b", &part, (int[4]){3, 3, 3, -1});
    expect_read(&part, 1, "lobes", &part, (int[4]){4, 4, 4, -1});
    expect_read(&part, 1, "normal", &part, (int[4]){5, 6, 7, -1});
    const char *path = temporary_folder_file(&test_folder, "fixture.exr");
    expect_file_error(path, "depth", LOBE_ERROR_NOT_FOUND);
    expect_file_error(path, "norm", LOBE_ERROR_NOT_FOUND);
    expect_file_error(path, "a", LOBE_ERROR_NOT_FOUND);
}

static void grey_images_are_spread(void **state) {
    (void)state;
    const exr_fixture_channel luminance[2] = {{"A", EXR_PIXEL_HALF, 1}, {"Y", EXR_PIXEL_HALF, 1}};
    const exr_fixture_channel height[1] = {{"height", EXR_PIXEL_FLOAT, 1}};
    exr_fixture_part part = plain_part(9, 7);
    part.channels = luminance;
    part.channel_count = 2;
    expect_read(&part, 1, NULL, &part, (int[4]){1, 1, 1, 0});
    part.channels = height;
    part.channel_count = 1;
    expect_read(&part, 1, NULL, &part, (int[4]){0, 0, 0, -1});
}

static void parts_are_searched_for_the_layer(void **state) {
    (void)state;
    const exr_fixture_channel depth[2] = {{"Z", EXR_PIXEL_FLOAT, 1}, {"weight", EXR_PIXEL_HALF, 1}};
    exr_fixture_part parts[2] = {plain_part(12, 40), plain_part(12, 40)};
    parts[0].name = "depth";
    parts[0].channels = depth;
    parts[0].channel_count = 2;
    parts[1].name = "beauty";
    expect_read(parts, 2, NULL, &parts[1], rgb_of_bgr);
    expect_read(parts, 2, "beauty", &parts[1], rgb_of_bgr);
    parts[0].channel_count = 1;
    expect_read(parts, 2, "depth", &parts[0], (int[4]){0, 0, 0, -1});
    parts[1].tile_width = parts[1].tile_height = 8;
    expect_read(parts, 2, "beauty", &parts[1], rgb_of_bgr);
}

static void subsampled_colour_differences_are_left_out_with_a_warning(void **state) {
    (void)state;
    const exr_fixture_channel channels[3] = {
        {"BY", EXR_PIXEL_HALF, 2}, {"RY", EXR_PIXEL_HALF, 2}, {"Y", EXR_PIXEL_HALF, 1}};
    const char *path = temporary_folder_file(&test_folder, "chroma.exr");
    exr_fixture_part part = plain_part(32, 20);
    part.channels = channels;
    part.compression = EXR_COMPRESSION_NONE;
    exr_fixture_write(path, &part, 1);
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    assert_int_equal(lobe_exr_read(path, NULL, &recorder.host, &image), LOBE_OK);
    assert_int_equal(recorder.warnings, 1);
    expect_channels(&image, &part, (int[4]){2, 2, 2, -1});
    lobe_image_free(&image);
}

static void what_is_not_supported_is_said(void **state) {
    (void)state;
    const exr_fixture_channel subsampled[3] = {
        {"B", EXR_PIXEL_HALF, 2}, {"G", EXR_PIXEL_HALF, 1}, {"R", EXR_PIXEL_HALF, 1}};
    const exr_fixture_channel strange[2] = {{"U", EXR_PIXEL_HALF, 1}, {"V", EXR_PIXEL_HALF, 1}};
    const char *path = temporary_folder_file(&test_folder, "strange.exr");
    exr_fixture_part part = plain_part(16, 16);
    part.compression = EXR_COMPRESSION_NONE;
    part.channels = subsampled;
    exr_fixture_write(path, &part, 1);
    expect_file_error(path, NULL, LOBE_ERROR_UNSUPPORTED);
    part.channels = strange;
    part.channel_count = 2;
    exr_fixture_write(path, &part, 1);
    expect_file_error(path, NULL, LOBE_ERROR_UNSUPPORTED);
}

// ---------------------------------------------------------------------------------------------
// Damage

/// A file in memory, to be written again with changes.
typedef struct file_content {
    uint8_t *data;
    size_t size;
} file_content;

static file_content load(const char *path) {
    file_content content;
    assert_int_equal(lobe_file_read(path, NULL, NULL, &content.data, &content.size), LOBE_OK);
    return content;
}

static void save(const char *path, const file_content *content, size_t size) {
    assert_int_equal(lobe_file_write(path, content->data, size, NULL), LOBE_OK);
}

/// The four numbers of a window attribute.
static uint8_t *find_window(const file_content *content, const char *name) {
    uint8_t *found = memmem(content->data, content->size, name, strlen(name) + 1);
    if (!found)
        fail_msg("no attribute '%s'", name);
    return found + strlen(name) + 1 + strlen("box2i") + 1 + 4;
}

static void set_window(const file_content *content, const char *name, int32_t left, int32_t top,
                       int32_t right, int32_t bottom) {
    const int32_t numbers[4] = {left, top, right, bottom};
    memcpy(find_window(content, name), numbers, sizeof numbers);
}

static void absurd_windows_are_refused(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "absurd.exr");
    exr_fixture_part part = plain_part(16, 16);
    exr_fixture_write(path, &part, 1);
    file_content content = load(path);
    set_window(&content, "displayWindow", 0, 0, 65535, 15);
    save(path, &content, content.size);
    expect_file_error(path, NULL, LOBE_ERROR_LIMIT);
    set_window(&content, "displayWindow", 0, 0, 65534,
               65534); // each extent is allowed, the area is not
    save(path, &content, content.size);
    expect_file_error(path, NULL, LOBE_ERROR_LIMIT);
    set_window(&content, "displayWindow", 0, 0, 15, 15);
    const int32_t windows[][4] = {
        {0, 0, INT32_MAX, INT32_MAX},
        {INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX},
        {0, 0, 65535, 15},
        {5, 5, 4, 4},
        {0, 0, 15, 65000},
        {INT32_MAX - 15, INT32_MAX - 15, INT32_MAX, INT32_MAX},
    };
    for (size_t index = 0; index < sizeof windows / sizeof windows[0]; index++) {
        const int32_t *w = windows[index];
        set_window(&content, "dataWindow", w[0], w[1], w[2], w[3]);
        save(path, &content, content.size);
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_image image;
        lobe_result result = lobe_exr_read(path, NULL, &recorder.host, &image);
        assert_true(result == LOBE_ERROR_LIMIT || result == LOBE_ERROR_MALFORMED);
        assert_int_equal(recorder.errors, 1);
        assert_null(image.texels);
    }
    lobe_release(content.data);
}

static void a_file_cut_off_anywhere_is_refused(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "cut.exr");
    for (int tiled = 0; tiled < 2; tiled++) {
        for (int compression = EXR_COMPRESSION_NONE; compression <= EXR_COMPRESSION_PXR24;
             compression++) {
            exr_fixture_part part = plain_part(30, 40);
            part.compression = (exr_compression_t)compression;
            part.tile_width = part.tile_height = tiled ? 16 : 0;
            exr_fixture_write(path, &part, 1);
            file_content content = load(path);
            for (size_t size = 0; size < content.size; size += 64) {
                save(path, &content, size);
                expect_file_error(path, NULL, LOBE_ERROR_MALFORMED);
            }
            save(path, &content, content.size - 1);
            expect_file_error(path, NULL, LOBE_ERROR_MALFORMED);
            lobe_release(content.data);
        }
    }
}

/// Any change results in an image or one log line, never in a crash.
static void expect_order(const char *path) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_image image;
    lobe_result result = lobe_exr_read(path, NULL, &recorder.host, &image);
    assert_int_equal(recorder.errors, result != LOBE_OK);
    assert_true((image.texels != NULL) == (result == LOBE_OK));
    assert_null(strpbrk(recorder.last_error, "\n\r\t\x1b"));
    lobe_image_free(&image);
}

static void any_byte_may_be_wrong(void **state) {
    (void)state;
    const uint8_t masks[3] = {0x01, 0x80, 0xff};
    const char *path = temporary_folder_file(&test_folder, "flipped.exr");
    for (int tiled = 0; tiled < 2; tiled++) {
        exr_fixture_part part = plain_part(20, 36);
        part.tile_width = part.tile_height = tiled ? 16 : 0;
        part.compression = tiled ? EXR_COMPRESSION_PIZ : EXR_COMPRESSION_ZIP;
        exr_fixture_write(path, &part, 1);
        file_content content = load(path);
        size_t header = content.size < 900 ? content.size : 900;
        for (size_t offset = 0; offset < header; offset++) {
            content.data[offset] ^= masks[offset % 3];
            save(path, &content, content.size);
            expect_order(path);
            content.data[offset] ^= masks[offset % 3];
        }
        lobe_release(content.data);
    }
}

static void damage_to_what_openexr_unpacks_is_seen(void **state) {
    (void)state;
    const char *path = temporary_folder_file(&test_folder, "dwa.exr");
    for (int tiled = 0; tiled < 2; tiled++) {
        write_dwa(path, IMF_DWAA_COMPRESSION, IMF_WRITE_RGB, tiled);
        file_content content = load(path);
        for (size_t size = 0; size < content.size; size += 97) {
            save(path, &content, size);
            expect_file_error(path, NULL, LOBE_ERROR_MALFORMED);
        }
        for (size_t offset = 0; offset < content.size; offset += 13) {
            content.data[offset] ^= 0x55;
            save(path, &content, content.size);
            expect_order(path);
            content.data[offset] ^= 0x55;
        }
        lobe_release(content.data);
    }
}

static void what_cannot_be_read_is_named(void **state) {
    (void)state;
    expect_file_error(temporary_folder_file(&test_folder, "missing.exr"), NULL,
                      LOBE_ERROR_NOT_FOUND);
    expect_file_error(test_folder.path, NULL, LOBE_ERROR_READ);
    const char *path = temporary_folder_file(&test_folder, "text.exr");
    assert_int_equal(lobe_file_write(path, "no image", 8, NULL), LOBE_OK);
    expect_file_error(path, NULL, LOBE_ERROR_MALFORMED);
}

static void damaged_files_of_the_wild_are_refused(void **state) {
    (void)state;
    DIR *directory = opendir(LOBE_ASSETS "/bad/exr");
    if (directory == NULL)
        skip();
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        if (entry->d_name[0] == '.')
            continue;
        char path[512];
        snprintf(path, sizeof path, "%s/bad/exr/%s", LOBE_ASSETS, entry->d_name);
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_image image;
        lobe_result result = lobe_exr_read(path, NULL, &recorder.host, &image);
        assert_true(result == LOBE_ERROR_MALFORMED || result == LOBE_ERROR_UNSUPPORTED);
        assert_int_equal(recorder.errors, 1);
        assert_non_null(strstr(recorder.last_error, path));
        assert_null(image.texels);
        count++;
    }
    closedir(directory);
    assert_true(count > 50);
}

static void files_of_the_wild_are_read(void **state) {
    (void)state;
    const char *names[3] = {"env/openexr_WavyLinesLatLong.exr", "height/terrain3d_stones.exr",
                            "env/deb_studio.exr"};
    for (int index = 0; index < 3; index++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", LOBE_ASSETS, names[index]);
        FILE *file = fopen(path, "rb");
        if (file == NULL)
            skip();
        fclose(file);
        lobe_image image;
        assert_int_equal(lobe_exr_read(path, NULL, NULL, &image), LOBE_OK);
        for (size_t channel = 0; channel < (size_t)4 * image.width * image.height; channel++)
            assert_true(isfinite(((const float *)image.texels)[channel]));
        lobe_image_free(&image);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_TEST_FOLDER(every_lossless_compression_is_read),
        IN_TEST_FOLDER(lossy_compression_is_read_too),
        IN_TEST_FOLDER(what_openexr_core_cannot_unpack_is_read),
        IN_TEST_FOLDER(sizes_down_to_one_texel_are_read),
        IN_TEST_FOLDER(the_finest_level_is_read),
        IN_TEST_FOLDER(all_channel_types_become_float),
        IN_TEST_FOLDER(the_display_window_frames_the_image),
        IN_TEST_FOLDER(layers_are_found_by_name),
        IN_TEST_FOLDER(grey_images_are_spread),
        IN_TEST_FOLDER(parts_are_searched_for_the_layer),
        IN_TEST_FOLDER(subsampled_colour_differences_are_left_out_with_a_warning),
        IN_TEST_FOLDER(what_is_not_supported_is_said),
        IN_TEST_FOLDER(absurd_windows_are_refused),
        IN_TEST_FOLDER(a_file_cut_off_anywhere_is_refused),
        IN_TEST_FOLDER(any_byte_may_be_wrong),
        IN_TEST_FOLDER(damage_to_what_openexr_unpacks_is_seen),
        IN_TEST_FOLDER(what_cannot_be_read_is_named),
        cmocka_unit_test(damaged_files_of_the_wild_are_refused),
        cmocka_unit_test(files_of_the_wild_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
