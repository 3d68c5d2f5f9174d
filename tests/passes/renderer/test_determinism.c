// The same pixels, bit for bit, in every run and with any number of the driver's threads. Each run
// is a process of its own, because lavapipe reads LP_NUM_THREADS when it creates a device: started
// with the argument "pixels", this program draws pictures and prints their hashes.

#include "tests/passes/support/fixture.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { WIDTH = 96, HEIGHT = 54, TEXT = 16384, MOST_FILTERS = 16 };

// ---------------------------------------------------------------------------------------------
// The run

static void print_hashes(fixture *f, const char *scene, const picture_request *request) {
    lobe_frame frame = draw(f, request);
    printf("%s %s %s %016" PRIx64 " %016" PRIx64 " %016" PRIx64 "\n", scene, request->filter,
           request->settings[0] ? request->settings[0] : "-", image_hash(&frame.radiance),
           image_hash(&frame.normal_depth), image_hash(&frame.lobes_level));
    lobe_frame_free(&frame);
}

/// Every other picture has outputs, as in the tests of validation and errors, which draw the same
/// scenes: the driver finds its shaders in its cache. If `first` is odd, the first picture has
/// some.
static void print_scene(fixture *f, const lobe_scene *scene, const char *const (*requests)[2],
                        size_t count, size_t first) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < count; i++) {
        picture_request request = {.filter = requests[i][0],
                                   .settings = {requests[i][1], NULL},
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .samples = 9,
                                   .outputs = (first + i) % 2};
        print_hashes(f, scene->name, &request);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
}

/// Mixtures are fitted for seconds to the maps of the built-in scenes: they are drawn with those of
/// the atlas.
static bool fits_mixtures(const char *filter) {
    return strcmp(filter, "mixture") == 0 || strcmp(filter, "tan") == 0 ||
           strcmp(filter, "fournier") == 0;
}

/// Each of the other filters in one scene: all scenes with all filters would compile shaders for
/// minutes.
static bool draws(size_t scene, size_t filter) {
    return (scene + filter) % lobe_builtin_scene_count() == 0 &&
           !fits_mixtures(lobe_filter_name(lobe_filter_get(filter)));
}

static void print_builtin_scenes(fixture *f) {
    assert_true(lobe_filter_count() <= MOST_FILTERS);
    for (size_t i = 0; i < lobe_builtin_scene_count(); i++) {
        const char *requests[MOST_FILTERS][2] = {{NULL}};
        size_t count = 0;
        for (size_t j = 0; j < lobe_filter_count(); j++)
            if (draws(i, j))
                requests[count++][0] = lobe_filter_name(lobe_filter_get(j));
        lobe_scene *scene;
        assert_int_equal(lobe_scene_open(lobe_builtin_scene_get(i)->name, NULL, &scene), LOBE_OK);
        print_scene(f, scene, requests, count, i);
        lobe_scene_destroy(&scene);
    }
}

/// Maps over an atlas, drawn by several adjacent triangles.
static lobe_scene *atlas_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    material.normal_map = scene_add_map(scene, random_normal_map(171, 57, 0.5, 91));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.4, 1, 0.9}, 3);
    scene_end(scene);
    return scene;
}

static void print_atlas_scene(fixture *f) {
    static const char *const requests[][2] = {{"lobes", "space=object"},
                                              {"lobes", "space=camera"},
                                              {"lobes", "storage=float16"},
                                              {"mipmap", "probes=3"},
                                              {"lobes", "samples=auto"},
                                              {"mixture", NULL},
                                              {"tan", NULL},
                                              {"fournier", NULL}};
    lobe_scene *scene = atlas_scene();
    print_scene(f, scene, requests, sizeof requests / sizeof *requests, 0);
    lobe_scene_destroy(&scene);
}

/// Bins that the device fits to other texels.
static void print_changed_scene(fixture *f) {
    static const uint32_t normals = 0;
    const picture_request request = {.filter = "moments", .width = WIDTH, .height = HEIGHT};
    lobe_scene *scene = atlas_scene();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame first = draw(f, &request);
    lobe_frame_free(&first);
    lobe_image other = random_normal_map(171, 57, 0.8, 92);
    lobe_image_free(&scene->images[normals].image);
    scene->images[normals].image = other;
    assert_int_equal(lobe_renderer_update_scene(
                         f->renderer, &(lobe_scene_changes){.images = &normals, .image_count = 1}),
                     LOBE_OK);
    print_hashes(f, "changed", &request);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static void draw_all(void **state) {
    print_builtin_scenes(*state);
    print_atlas_scene(*state);
    print_changed_scene(*state);
}

static int draw_and_print(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(draw_all)};
    cmocka_set_message_output(CM_OUTPUT_SUBUNIT);
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}

// ---------------------------------------------------------------------------------------------
// The comparison

/// The lines with hashes that a run prints, with LP_NUM_THREADS as given.
static void run(const char *threads, char text[TEXT]) {
    char program[PATH_MAX], command[PATH_MAX + 32], line[256];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    assert_true(length > 0);
    program[length] = '\0';
    snprintf(command, sizeof command, "'%s' pixels", program);
    assert_int_equal(setenv("LP_NUM_THREADS", threads, 1), 0);
    FILE *output = popen(command, "r");
    assert_non_null(output);
    text[0] = '\0';
    while (fgets(line, sizeof line, output)) {
        if (strchr(line, ' ') && strlen(line) > 48 && strlen(text) + strlen(line) < TEXT)
            strcat(text, line);
    }
    int status = pclose(output);
    assert_int_equal(status, 0);
    size_t lines = 0, pictures = 9;
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    for (size_t i = 0; i < lobe_builtin_scene_count() * lobe_filter_count(); i++)
        pictures += draws(i / lobe_filter_count(), i % lobe_filter_count());
    assert_int_equal(lines, pictures);
}

/// Two runs with different numbers of threads: if they agree, neither matters.
static void pixels_do_not_depend_on_run_or_threads(void **state) {
    (void)state;
    static char first[TEXT], other[TEXT];
    run("2", first);
    run("0", other);
    if (strcmp(first, other) != 0)
        fail_msg("LP_NUM_THREADS=0:\n%snot as with 2:\n%s", other, first);
}

/// Hashes differ between pictures.
static void hashes_tell_pictures_apart(void **state) {
    (void)state;
    float texels[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    lobe_image image = {LOBE_FORMAT_RGBA32_FLOAT, 2, 1, texels};
    uint64_t before = image_hash(&image);
    texels[7] = nextafterf(7, 8);
    assert_true(image_hash(&image) != before);
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "pixels") == 0)
        return draw_and_print();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hashes_tell_pictures_apart),
        cmocka_unit_test(pixels_do_not_depend_on_run_or_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
