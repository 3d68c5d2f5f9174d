// Milliseconds of a frame of 1280x720 in which all texels of a normal map changed, for maps of
// several sizes on the same view: the table of docs/program.md, "Large maps". ninja large_maps. The
// last column is the process's CPU time, with which other programs interfere least.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { FRAMES = 3, LARGEST = 8192 };

/// Hills of many sizes, down to single texels.
static lobe_image hills(uint32_t extent) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA8_UNORM, extent, extent);
    uint32_t state = 1;
    for (uint32_t y = 0; y < extent; y++) {
        for (uint32_t x = 0; x < extent; x++) {
            unsigned char *texel = (unsigned char *)image.texels + 4 * ((size_t)y * extent + x);
            state = state * 1664525u + 1013904223u;
            const float u = (float)x / (float)extent, v = (float)y / (float)extent;
            const float wave = sinf(300 * u + 5 * v) + sinf(40 * v - 700 * u);
            texel[0] = (unsigned char)(128 + 15 * wave + (float)(state >> 27));
            texel[1] = (unsigned char)(128 + 20 * sinf(500 * v) + (float)(state >> 22 & 31));
            texel[2] = 245;
            texel[3] = 255;
        }
    }
    return image;
}

static lobe_scene *plane_of(uint32_t extent) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.3, 1);
    material.normal_map = scene_add_map(scene, hills(extent));
    scene_add_square(scene, &material, 1, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 1.1);
    scene_end(scene);
    return scene;
}

static const struct {
    const char *name;
    uint32_t smallest; ///< extent of which it is measured
    const char *settings[4];
} ways[] = {
    {"whole", 1024, {"built=whole"}},
    {"seen", LARGEST, {"built=seen"}},
    {"seen, 64 samples", LARGEST, {"built=seen", "texel_samples=64"}},
    {"seen, 16 samples", LARGEST, {"built=seen", "texel_samples=16"}},
    {"seen, 4 samples", 1024, {"built=seen", "texel_samples=4"}},
};

/// The columns, and the passes that are in them. What is left of the frame is the range of texels
/// and the fit to them: lavapipe counts compute shaders that read images among whatever comes next.
static const struct {
    const char *name, *passes[4];
} columns[] = {
    {"marking", {"tile_marking", "tile_list"}},
    {"binning", {"moment_binning"}},
    {"levels", {"level_reduction"}},
    {"shading", {"shading"}},
    {"range and fit", {NULL}},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double milliseconds_of(const lobe_frame *frame, size_t column) {
    double sum = 0;
    for (size_t i = 0; i < frame->pass_count; i++)
        for (int k = 0; k < 4 && columns[column].passes[k]; k++)
            if (strncmp(frame->passes[i].name, columns[column].passes[k],
                        strlen(columns[column].passes[k])) == 0)
                sum += frame->passes[i].milliseconds;
    return sum;
}

static void measure(fixture *f, uint32_t extent, size_t way) {
    const lobe_filter *filter = filter_named("moments");
    const lobe_settings settings = settings_of(filter, ways[way].settings);
    const lobe_render_parameters parameters = {
        .filter = filter, .settings = &settings, .width = 1280, .height = 720, .rebuild = true};
    double times[COLUMNS + 2][FRAMES];
    for (int n = -1; n < FRAMES; n++) { // the first makes the pipelines
        lobe_frame frame;
        const clock_t begin = clock();
        if (lobe_renderer_render(f->renderer, &parameters, &frame) != LOBE_OK)
            fail_msg("%s", f->error);
        if (n >= 0)
            times[COLUMNS + 1][n] = (double)(clock() - begin) * 1000 / CLOCKS_PER_SEC;
        for (size_t c = 0; n >= 0 && c < COLUMNS - 1; c++)
            times[c][n] = milliseconds_of(&frame, c);
        if (n >= 0)
            times[COLUMNS - 1][n] = times[COLUMNS][n] = frame.milliseconds;
        for (size_t c = 0; n >= 0 && c < COLUMNS - 1; c++)
            times[COLUMNS - 1][n] -= times[c][n];
        lobe_frame_free(&frame);
    }
    printf("| %u² | %s |", extent, ways[way].name);
    for (size_t c = 0; c < COLUMNS + 2; c++) {
        qsort(times[c], FRAMES, sizeof **times, compare);
        printf(" %.0f |", times[c][FRAMES / 2]);
    }
    printf("\n");
    fflush(stdout);
}

static void maps_of_several_sizes(void **state) {
    fixture *f = *state;
    printf("| map | built | marking | binning | levels | shading | range and fit | frame | CPU |\n"
           "|---|---|---|---|---|---|---|---|---|\n");
    for (uint32_t extent = 1024; extent <= LARGEST; extent *= 2) {
        lobe_scene *scene = plane_of(extent);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
        // One frame with the first texels: what follows fits bins to others on the device.
        lobe_frame frame;
        const picture_request request = {.filter = "moments", .width = 16, .height = 16};
        frame = draw(f, &request);
        lobe_frame_free(&frame);
        const uint32_t changed = 0;
        const lobe_scene_changes changes = {.images = &changed, .image_count = 1};
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        for (size_t way = 0; way < sizeof ways / sizeof *ways; way++)
            if (extent >= ways[way].smallest)
                measure(f, extent, way);
        assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
        lobe_scene_destroy(&scene);
    }
    assert_int_equal(f->errors, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(maps_of_several_sizes)};
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
