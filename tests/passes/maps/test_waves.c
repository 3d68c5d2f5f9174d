// Waves that the host gives: their moments against surfaces in double precision, and pictures of
// the filter against many samples of the maps, near and far.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/ocean.h>

#include "shaders/interface/waves.h"
#include "tests/passes/maps/wave_fields.h"
#include "tests/passes/support/misuse.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 16 };

static lobe_ocean_parameters sea_of(uint32_t size) {
    lobe_ocean_parameters sea;
    lobe_ocean_default(&sea);
    sea.size = size;
    sea.wind_direction = 0.5f;
    return sea;
}

static lobe_material water_of(const lobe_ocean_parameters *sea) {
    lobe_ocean_slopes slopes;
    assert_int_equal(lobe_ocean_measure(sea, NULL, &slopes), LOBE_OK);
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.05, 1);
    material.base_colour[0] = material.base_colour[1] = material.base_colour[2] = 0.02f;
    material.waves =
        (lobe_waves){.layers = sea->layers, .size = sea->size, .choppy = sea->choppiness > 0};
    memcpy(material.waves.lengths, sea->lengths, sizeof sea->lengths);
    memcpy(material.waves.rest, slopes.rest, sizeof slopes.rest);
    memcpy(material.waves.total, slopes.total, sizeof slopes.total);
    return material;
}

typedef struct seascape {
    fixture *f;
    lobe_scene *scene;
    lobe_ocean *ocean;
    double seconds;
    bool silent; ///< gives nothing
} seascape;

static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    const seascape *s = user;
    if (!s->silent)
        content->waves[0] = lobe_ocean_add(s->ocean, graph, s->seconds);
}

static void sky(const double direction[3], float radiance[3]) {
    const double height = fmax(direction[1], 0);
    radiance[0] = (float)(1.2 - 0.9 * height + 0.3 * direction[0]);
    radiance[1] = (float)(1.1 - 0.6 * height);
    radiance[2] = (float)(1.0 - 0.1 * height);
}

/// `metres` of a sea, seen by a viewer 20 degrees above the horizon, towards the sun or under the
/// sky.
static void begin(seascape *s, const lobe_ocean_parameters *sea, const lobe_material *material,
                  double metres, bool sun) {
    s->scene = scene_begin();
    scene_add_square(s->scene, material, metres, NULL);
    if (sun)
        scene_add_sun(s->scene, (double[]){0.2, 0.5, -0.9}, 3);
    else
        scene_surround(s->scene, 32, sky);
    scene_look_from(s->scene, (double[]){0.1, 0.36, 0.93}, 0.6);
    scene_end(s->scene);
    assert_int_equal(lobe_ocean_create(s->f->device, sea, &s->f->host, &s->ocean), LOBE_OK);
    lobe_renderer_set_content_giver(s->f->renderer, give, s);
    assert_int_equal(lobe_renderer_set_scene(s->f->renderer, s->scene), LOBE_OK);
}

static void end(seascape *s) {
    assert_int_equal(lobe_renderer_set_scene(s->f->renderer, NULL), LOBE_OK);
    lobe_renderer_set_content_giver(s->f->renderer, NULL, NULL);
    lobe_ocean_destroy(&s->ocean);
    lobe_scene_destroy(&s->scene);
    assert_int_equal(lobe_device_validation_count(s->f->device), 0);
}

// ---------------------------------------------------------------------------------------------
// Pictures

static double mean_of(const lobe_image *image) {
    double sum = 0;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++)
        sum += ((const float *)image->texels)[4 * i + 1];
    return sum / ((double)image->width * image->height);
}

/// Means over blocks of 4 x 4 pixels, which leave a quarter of the samples' noise.
static void average_blocks(lobe_image *image) {
    float *texels = image->texels;
    const uint32_t columns = image->width / 4, rows = image->height / 4;
    for (uint32_t y = 0; y < rows; y++)
        for (uint32_t x = 0; x < columns; x++)
            for (uint32_t c = 0; c < 4; c++) {
                double sum = 0;
                for (uint32_t i = 0; i < 16; i++)
                    sum += pixel_at(image, 4 * x + i % 4, 4 * y + i / 4)[c];
                // Behind all that are still to be read.
                texels[4 * (y * columns + x) + c] = (float)(sum / 16);
            }
    image->width = columns;
    image->height = rows;
}

typedef struct comparison {
    double metres;
    bool sun;
    double error, mean; ///< at most: relative L2 of blocks, and how far the mean is off
} comparison;

static void compare(fixture *f, const comparison *c) {
    const lobe_ocean_parameters sea = sea_of(64);
    const lobe_material material = water_of(&sea);
    seascape s = {.f = f, .seconds = 3};
    begin(&s, &sea, &material, c->metres, c->sun);
    const picture_request filtered = {
        "leadr", {"probes=4", "env=mip", "env_size=64"}, EXTENT, EXTENT, 1, false};
    const picture_request many = {"reference", {"env_size=64"}, EXTENT, EXTENT, 256, false};
    lobe_frame a = draw(f, &filtered), b = draw(f, &many);
    const double mean = mean_of(&a.radiance) / mean_of(&b.radiance) - 1;
    average_blocks(&a.radiance);
    average_blocks(&b.radiance);
    const double error = relative_l2(&a.radiance, &b.radiance);
    if (!(error <= c->error && fabs(mean) <= c->mean))
        fail_msg("%g m: error %g, mean off by %g", c->metres, error, mean);
    lobe_frame_free(&a);
    lobe_frame_free(&b);
    end(&s);
}

// Near, in the middle and far away.
static void filter_agrees_with_many_samples(void **state) {
    static const comparison comparisons[] = {
        {3, true, 0.04, 0.03},     {60, true, 0.07, 0.02},     {1000, true, 0.05, 0.02},
        {40000, true, 0.05, 0.02}, {3, false, 0.02, 0.01},     {60, false, 0.03, 0.01},
        {1000, false, 0.03, 0.01}, {40000, false, 0.02, 0.02},
    };
    for (size_t i = 0; i < sizeof comparisons / sizeof *comparisons; i++)
        compare(*state, &comparisons[i]);
}

static double far_mean(fixture *f, const lobe_ocean_parameters *sea, const char *setting) {
    const lobe_material material = water_of(sea);
    seascape s = {.f = f, .seconds = 3};
    begin(&s, sea, &material, 30000, setting == NULL);
    const picture_request request = {"leadr", {"env_size=64", setting}, 4, 4, 1, false};
    lobe_frame frame = draw(f, &request);
    const double mean = mean_of(&frame.radiance);
    lobe_frame_free(&frame);
    end(&s);
    return mean;
}

// What few texels cannot hold widens the highlight of each.
static void far_sea_does_not_depend_on_the_size(void **state) {
    lobe_ocean_parameters sea = sea_of(256);
    const double fine = far_mean(*state, &sea, NULL);
    for (sea.size = 8; sea.size < 256; sea.size *= 4)
        assert_true(fabs(far_mean(*state, &sea, NULL) / fine - 1) < 0.03);
}

// The sum over a grid of slopes is the integral over all texels of the sky.
static void sky_is_integrated(void **state) {
    const lobe_ocean_parameters sea = sea_of(32);
    const double exact = far_mean(*state, &sea, "env=exact");
    const double grid = far_mean(*state, &sea, "env=mip");
    if (!(fabs(grid / exact - 1) < 0.03))
        fail_msg("%g, exactly %g", grid, exact);
}

// ---------------------------------------------------------------------------------------------
// Moments

enum { SIZE = 16, POINTS = 8 }; // along each side of the map, of a texel

/// Fields of one layer of waves, smooth enough for them to fold nowhere but at a few texels.
static void fill_fields(lobe_image *image, uint64_t seed, double amplitude) {
    lobe_image random = random_map(SIZE, SIZE, -amplitude, amplitude, seed);
    memcpy(image->texels, random.texels, sizeof(float[4]) * SIZE * SIZE);
    lobe_image_free(&random);
}

/// Of the surface's normal, the cross product of its tangents: its height over the plane is the
/// area, its tilt the slope.
static void add_moments(const lobe_image images[2], double x, double y, double moments[6]) {
    double place[4], gradients[4];
    wave_field_at(&images[0], x, y, place);
    wave_field_at(&images[1], x, y, gradients);
    const double a[3] = {1 + gradients[2], place[3], gradients[0]},
                 b[3] = {place[3], 1 + gradients[3], gradients[1]};
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    if (n[2] <= 0)
        return;
    double slope[2] = {-n[0] / n[2], -n[1] / n[2]};
    const double length = fmax(hypot(slope[0], slope[1]) / WAVE_SLOPE_MAXIMUM, 1);
    slope[0] /= length;
    slope[1] /= length;
    const double terms[6] = {
        1, slope[0], slope[1], slope[0] * slope[0], slope[1] * slope[1], slope[0] * slope[1]};
    for (int i = 0; i < 6; i++)
        moments[i] += n[2] * terms[i];
}

/// The mean slope and the covariance of the whole map, by many points.
static void integrate(const lobe_image images[2], double mean[2], double covariance[3]) {
    double moments[6] = {0};
    for (int y = 0; y < POINTS * SIZE; y++)
        for (int x = 0; x < POINTS * SIZE; x++)
            add_moments(images, (x + 0.5) / POINTS, (y + 0.5) / POINTS, moments);
    mean[0] = moments[1] / moments[0];
    mean[1] = moments[2] / moments[0];
    covariance[0] = moments[3] / moments[0] - mean[0] * mean[0];
    covariance[1] = moments[4] / moments[0] - mean[1] * mean[1];
    covariance[2] = moments[5] / moments[0] - mean[0] * mean[1];
}

// From straight above nothing is masked: what is seen of a sun is F D/4 of it.
static void moments_are_those_of_the_surface(void **state) {
    static const double suns[][3] = {{0.2, 1, -0.1}, {-0.3, 1, 0.2}, {0.1, 1, 0.4}},
                        above[3] = {0, 1, 0};
    fixture *f = *state;
    lobe_image images[2];
    wave_fields given;
    for (uint32_t i = 0; i < 2; i++) {
        images[i] = map_image(LOBE_FORMAT_RGBA32_FLOAT, SIZE, SIZE);
        fill_fields(&images[i], 7 + i, i == 0 ? 0.1 : 0.3);
    }
    wave_fields_upload(f, images, &given);
    double mean[2], covariance[3];
    integrate(images, mean, covariance);
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.05, 1);
    material.waves =
        (lobe_waves){.layers = 1, .size = SIZE, .lengths = {1}, .rest = {0.02f, 0.03f, 0.01f}};
    const double base = 0.5 * pow(0.05, 4);
    for (int i = 0; i < 3; i++)
        covariance[i] += material.waves.rest[i] + (i < 2 ? base : 0);
    for (size_t i = 0; i < sizeof suns / sizeof *suns; i++) {
        // The tangent frame is (+X, -Z, +Y).
        const double length = sqrt(suns[i][0] * suns[i][0] + 1 + suns[i][2] * suns[i][2]);
        const double h[3] = {suns[i][0] / length, -suns[i][2] / length, 1 / length + 1};
        const double half[2] = {-h[0] / h[2], -h[1] / h[2]};
        const double cosine = h[2] / sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
        // Of a white metal.
        const double expected = slope_density_at(half, mean, covariance) / (4 * pow(cosine, 4));
        const double seen = wave_fields_seen_from(f, &material, &given, above, suns[i]);
        if (!(fabs(seen / expected - 1) < 0.02))
            fail_msg("%g, expected %g", seen, expected);
    }
    wave_fields_free(&given);
    for (uint32_t i = 0; i < 2; i++)
        lobe_image_free(&images[i]);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void refuse(fixture *f, const lobe_material *material, const char *words) {
    lobe_scene *scene = scene_begin();
    scene_add_map(scene, constant_map(1, 1, 1, 1, 1));
    scene_add_square(scene, material, 1, NULL);
    scene_look_down(scene, 2);
    scene_end(scene);
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_set_scene(f->renderer, scene), LOBE_ERROR_MALFORMED, words);
    lobe_scene_destroy(&scene);
}

static void nonsense_is_refused(void **state) {
    const lobe_ocean_parameters sea = sea_of(16);
    const lobe_material good = water_of(&sea);
    lobe_material bad = good;
    bad.waves.layers = 9;
    refuse(*state, &bad, "layers of waves");
    bad = good;
    bad.waves.size = 17;
    refuse(*state, &bad, "17 texels");
    bad = good;
    bad.waves.lengths[1] = 0;
    refuse(*state, &bad, "lengths of waves");
    bad = good;
    bad.waves.rest[2] = NAN;
    refuse(*state, &bad, "rest of waves");
    bad = good;
    bad.waves.total[0] = INFINITY;
    refuse(*state, &bad, "total of waves");
    bad = good;
    bad.alpha_mask = true;
    refuse(*state, &bad, "waves and a mask");
    bad = good;
    bad.normal_map.image = 0;
    refuse(*state, &bad, "waves and a normal map");
    bad = good;
    bad.height_map.image = 0;
    refuse(*state, &bad, "waves and a map of heights");
}

static void missing_and_wrong_maps_fail_in_one_line(void **state) {
    fixture *f = *state;
    lobe_ocean_parameters sea = sea_of(16);
    lobe_material material = water_of(&sea);
    const lobe_render_parameters parameters = {
        .filter = filter_named("leadr"), .width = 8, .height = 8};
    seascape s = {.f = f, .silent = true};
    begin(&s, &sea, &material, 10, true);
    check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, "gave none");
    end(&s);
    s = (seascape){.f = f};
    material.waves.size = 32;
    begin(&s, &sea, &material, 10, true);
    check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, "expected 32x32");
    end(&s);
    material.waves.layers = 0;
    s = (seascape){.f = f};
    begin(&s, &sea, &material, 10, true);
    check_render_failure(f, &parameters, LOBE_ERROR_INVALID_ARGUMENT, "has no waves");
    end(&s);
}

// Other filters say so, and show a smooth surface.
static void other_filters_warn(void **state) {
    fixture *f = *state;
    const lobe_ocean_parameters sea = sea_of(16);
    const lobe_material material = water_of(&sea);
    seascape s = {.f = f};
    begin(&s, &sea, &material, 10, true);
    fixture_forget_messages(f);
    const picture_request request = {"mipmap", {NULL}, 8, 8, 1, false};
    lobe_frame frame = draw(f, &request);
    assert_true(f->errors == 0 && f->warnings == 1);
    assert_false(lobe_filter_draws_waves(filter_named("mipmap")));
    assert_true(lobe_filter_draws_waves(filter_named("reference")));
    assert_true(all_finite(&frame.radiance));
    lobe_frame_free(&frame);
    end(&s);
}

// A steep sea, a calm one, and a viewer at the horizon.
static void extremes_have_finite_pictures(void **state) {
    static const float winds[] = {0, 60};
    for (size_t i = 0; i < 2; i++) {
        lobe_ocean_parameters sea = sea_of(32);
        sea.wind_speed = winds[i];
        sea.choppiness = 2;
        const lobe_material material = water_of(&sea);
        seascape s = {.f = *state};
        begin(&s, &sea, &material, 300, true);
        s.scene->camera.eye[1] = 1e-4f;
        const picture_request request = {"leadr", {NULL}, 16, 16, 1, false};
        lobe_frame frame = draw(*state, &request);
        assert_true(all_finite(&frame.radiance));
        lobe_frame_free(&frame);
        end(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_are_those_of_the_surface),
        cmocka_unit_test(nonsense_is_refused),
        cmocka_unit_test(missing_and_wrong_maps_fail_in_one_line),
        cmocka_unit_test(other_filters_warn),
        cmocka_unit_test(extremes_have_finite_pictures),
        cmocka_unit_test(far_sea_does_not_depend_on_the_size),
        cmocka_unit_test(sky_is_integrated),
        cmocka_unit_test(filter_agrees_with_many_samples),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
