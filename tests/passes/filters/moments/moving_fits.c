// How pictures of `moments` change, and how far they are from the reference, while maps change from
// frame to frame, with bins that are fitted anew in each and with bins that follow: the table of
// docs/program.md, "Maps that change in every frame". ninja moving_fits.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16, WIDTH = 32, HEIGHT = 20, FRAMES = 100, CHECKS = 10, WAYS = 2 };

typedef void (*slope_at)(double time, double x, double y, double slope[2]);

static double hashed(uint32_t n) {
    n = (n ^ 61) ^ (n >> 16);
    n *= 9;
    n ^= n >> 4;
    n *= 0x27d4eb2d;
    n ^= n >> 15;
    return (double)n / 4294967296.0;
}

static double noise(uint32_t seed, double x, double y) {
    return 2 * hashed(seed * 7919u + (uint32_t)x + 64 * (uint32_t)y) - 1;
}

// Slopes at a texel. Constants were found on these.

static void ripples(double t, double x, double y, double s[2]) {
    const double u = 2 * M_PI * x / EXTENT, v = 2 * M_PI * y / EXTENT;
    s[0] = 0.4 * cos(t) + 0.5 * cos(3 * u + t);
    s[1] = 0.4 * sin(t) + 0.5 * cos(2 * u + 3 * v - t);
}

static void growing_bumps(double t, double x, double y, double s[2]) {
    const double u = M_PI / 8 * x, v = M_PI / 8 * y, a = 0.1 + 0.3 * t;
    s[0] = a * sin(u) * (1 + cos(v));
    s[1] = a * sin(v) * (1 + cos(u));
}

static void morphing_noise(double t, double x, double y, double s[2]) {
    for (int i = 0; i < 2; i++)
        s[i] = 0.5 * ((1 - t) * noise(1 + i, x, y) + t * noise(3 + i, x, y) * fabs(noise(8, x, y)));
}

static void switching_noise(double t, double x, double y, double s[2]) {
    const int n = (int)(t / 20);
    for (int i = 0; i < 2; i++)
        s[i] = 0.5 * hashed(90u + 2 * n + i) +
               0.6 * hashed(70u + n) * noise(30 + 5 * n + i, x, y) * noise(32 + 5 * n, x, y);
}

// The others.

static void waves(double t, double x, double y, double s[2]) {
    const double u = 2 * M_PI * x / EXTENT, v = 2 * M_PI * y / EXTENT;
    const double a = 0.3 * cos(u + 2 * v + 2 * t), b = 0.3 * cos(5 * u - 3 * v - 3 * t),
                 c = 0.2 * cos(7 * u + 9 * v + t);
    s[0] = a + 5 * b / 6 + c;
    s[1] = 2 * a - b / 2 + c;
}

static void turning_facets(double t, double x, double y, double s[2]) {
    const int side = ((int)(x / 4) + (int)(y / 4)) % 3;
    const double angle = side * 2 * M_PI / 3 + t, a = 0.3 + 0.1 * side;
    s[0] = a * cos(angle) + 0.03 * noise(5, x, y);
    s[1] = a * sin(angle) + 0.03 * noise(6, x, y);
}

static void turning_grooves(double t, double x, double y, double s[2]) {
    const double a = 0.7 * sin(2.7 * x * (1 + 0.01 * sin(y)));
    s[0] = a * cos(t);
    s[1] = a * sin(t) + 0.1 * noise(7, x, y);
}

static void advancing_noise(double t, double x, double y, double s[2]) {
    const double part = 1 / (1 + exp((x - EXTENT * t) / 1.5));
    s[0] = 0.2 * (1 - part) + part * 0.7 * noise(10, x, y);
    s[1] = -0.1 * (1 - part) + part * 0.7 * noise(11, x, y);
}

static void switching(double t, double x, double y, double s[2]) {
    static const slope_at all[] = {turning_grooves, turning_facets, ripples, morphing_noise};
    all[(int)(t / 20) % 4](0.3 + 0.002 * t, x, y, s);
}

static const struct {
    const char *name;
    slope_at slopes;
    double step, roughness;
} sequences[] = {
    {"ripples", ripples, 0.01, 0.25},
    {"growing bumps", growing_bumps, 0.01, 0.2},
    {"morphing noise", morphing_noise, 0.01, 0.3},
    {"ripples, quick", ripples, 0.2, 0.25},
    {"switching noise", switching_noise, 1, 0.3},
    {"waves", waves, 0.01, 0.2},
    {"waves, quick", waves, 0.2, 0.2},
    {"turning facets", turning_facets, 0.02, 0.2},
    {"turning facets, quick", turning_facets, 0.3, 0.2},
    {"turning grooves", turning_grooves, 0.02, 0.3},
    {"turning grooves, quick", turning_grooves, 0.3, 0.3},
    {"advancing noise", advancing_noise, 0.01, 0.15},
    {"switching", switching, 1, 0.25},
};

static void fill(lobe_image *image, size_t sequence, double time) {
    for (uint32_t y = 0; y < EXTENT; y++)
        for (uint32_t x = 0; x < EXTENT; x++) {
            float *texel = (float *)image->texels + 4 * (y * EXTENT + x);
            double s[2];
            sequences[sequence].slopes(time, x, y, s);
            const double length = sqrt(1 + s[0] * s[0] + s[1] * s[1]);
            texel[0] = (float)(0.5 - 0.5 * s[0] / length);
            texel[1] = (float)(0.5 - 0.5 * s[1] / length);
            texel[2] = (float)(0.5 + 0.5 / length);
            texel[3] = 1;
        }
}

static lobe_scene *make_scene(size_t sequence) {
    lobe_scene *scene = scene_begin();
    lobe_material material =
        microfacet_material(LOBE_DISTRIBUTION_GGX, sequences[sequence].roughness, 1);
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    fill(&image, sequence, 0);
    material.normal_map = scene_add_map(scene, image);
    scene_add_square(scene, &material, 8, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_add_sun(scene, (double[]){-0.8, 1, 0.3}, 2);
    scene_add_sun(scene, (double[]){0.2, 0.6, -1}, 2);
    scene_look_from(scene, (double[]){0.3, 1, 0.4}, 1.1);
    for (int i = 0; i < 3; i++)
        scene->camera.eye[i] *= 0.3f;
    scene->camera.orthographic_height = 0;
    scene->camera.vertical_field_of_view = 1;
    scene_end(scene);
    return scene;
}

static lobe_frame render(lobe_renderer *renderer, const char *filter,
                         const lobe_settings *settings) {
    const lobe_render_parameters parameters = {.filter = filter_named(filter),
                                               .settings = settings,
                                               .width = WIDTH,
                                               .height = HEIGHT,
                                               .reference.samples = 64};
    lobe_frame frame;
    assert_int_equal(lobe_renderer_render(renderer, &parameters, &frame), LOBE_OK);
    return frame;
}

/// A sequence, drawn with bins that are fitted anew in each frame, and with bins that follow.
typedef struct measured {
    double differences[FRAMES], errors[FRAMES / CHECKS], milliseconds;
} measured;

static double refit_time(const lobe_frame *frame) {
    double sum = 0;
    for (size_t k = 0; k < frame->pass_count; k++)
        if (strcmp(frame->passes[k].name, "moment_refit") == 0)
            sum += frame->passes[k].milliseconds;
    return sum;
}

static const lobe_scene_changes changes = {.images = (const uint32_t[]){0}, .image_count = 1};

/// Draws frame `i`, and puts its picture in the place of the one before.
static void draw_next(lobe_renderer *renderer, const lobe_settings *settings, int i,
                      const lobe_image *reference, lobe_image *before, measured *result) {
    assert_int_equal(lobe_renderer_update_scene(renderer, &changes), LOBE_OK);
    lobe_frame frame = render(renderer, "moments", settings);
    result->milliseconds += refit_time(&frame);
    if (before->texels)
        result->differences[i - 1] = relative_l2(&frame.radiance, before);
    if (reference)
        result->errors[i / CHECKS - 1] = relative_l2(&frame.radiance, reference);
    lobe_image_free(before);
    *before = frame.radiance;
    frame.radiance = (lobe_image){0};
    lobe_frame_free(&frame);
}

static void measure(fixture *f, size_t sequence, measured all[WAYS]) {
    const lobe_settings settings[WAYS] = {
        settings_of(filter_named("moments"), (const char *[]){"refit=anew", NULL}),
        settings_of(filter_named("moments"), (const char *[]){"refit=follow", NULL})};
    lobe_renderer *renderers[WAYS];
    lobe_image before[WAYS] = {0};
    lobe_scene *scene = make_scene(sequence);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (int w = 0; w < WAYS; w++) {
        assert_int_equal(lobe_renderer_create(f->device, &f->host, &renderers[w]), LOBE_OK);
        assert_int_equal(lobe_renderer_set_scene(renderers[w], scene), LOBE_OK);
        lobe_frame first = render(renderers[w], "moments", &settings[w]);
        lobe_frame_free(&first);
    }
    for (int i = 1; i <= FRAMES; i++) {
        lobe_frame reference = {0};
        fill(&scene->images[0].image, sequence, sequences[sequence].step * i);
        if (i % CHECKS == 0) {
            assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
            reference = render(f->renderer, "reference", NULL);
        }
        for (int w = 0; w < WAYS; w++)
            draw_next(renderers[w], &settings[w], i, i % CHECKS == 0 ? &reference.radiance : NULL,
                      &before[w], &all[w]);
        lobe_frame_free(&reference);
    }
    for (int w = 0; w < WAYS; w++) {
        lobe_image_free(&before[w]);
        lobe_renderer_destroy(&renderers[w]);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(const char *name, measured all[WAYS]) {
    printf("| %s |", name);
    for (int w = 0; w < WAYS; w++) {
        double mean = 0;
        for (int i = 0; i < FRAMES / CHECKS; i++)
            mean += all[w].errors[i] * CHECKS / FRAMES;
        // Of the first picture there is none before.
        qsort(all[w].differences + 1, FRAMES - 1, sizeof(double), compare);
        printf(" %.3f, %.3f | %.4f, %.4f |", mean, all[w].errors[FRAMES / CHECKS - 1],
               all[w].differences[FRAMES / 2], all[w].differences[FRAMES - 1]);
    }
    printf(" %.2f |\n", all[1].milliseconds / all[0].milliseconds);
    fflush(stdout);
}

static void maps_move(void **state) {
    printf("| maps | anew: error, mean and last | change, median and most | follow: error | change "
           "| time of the fit, follow / anew |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof sequences / sizeof *sequences; i++) {
        measured all[WAYS] = {0};
        measure(*state, i, all);
        print(sequences[i].name, all);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(maps_move)};
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
