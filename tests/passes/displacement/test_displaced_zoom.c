// The same relief from near to 64 times as far: its mean radiance stays, whether triangles, masking
// or the distribution of slopes hold it.
//
// `test_displacement_displaced_zoom flight` prints by how much frames of a flight differ from those
// before, and those of the reference, for a relief made here; `... FILE...` for height maps in
// files.

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/filters/wu/sample_reliefs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { MAP = 256, EXTENT = 64 };

/// Tiles of one metre, so many in both directions, under a sun that is nearly straight above. The
/// map becomes the scene's.
static lobe_scene *plane_of(lobe_image map, float scale, float tiles, const lobe_camera *camera) {
    const float half = 0.5f * tiles;
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, 0);
    material.height_map = scene_add_map(scene, map);
    material.height_scale = scale;
    scene_add_square(scene, &material, (double)tiles,
                     (float[]){half, 0, 0, 0, 0, half, 0, 0, 0, 0, half, 0, 0, 0, 0, 1});
    scene_add_sun(scene, (double[]){0.1, 1, 0.1}, 3);
    scene_end(scene);
    scene->camera = *camera;
    scene->has_camera = true;
    return scene;
}

/// The picture shows `tiles` of them across, always whole ones.
static lobe_scene *relief_at(double angle, double tiles) {
    float scale;
    lobe_image map = gaussian_heights(MAP, 0.5, 11, &scale);
    return plane_of(map, scale, 400,
                    &(lobe_camera){.eye = {0, (float)(300 * cos(angle)), (float)(300 * sin(angle))},
                                   .up = {0, 1, 0},
                                   .orthographic_height = (float)tiles,
                                   .near_plane = 1});
}

static double mean_of(fixture *f, double angle, double tiles, const picture_request *request) {
    lobe_scene *scene = relief_at(angle, tiles);
    lobe_frame frame = draw_scene(f, scene, request);
    double sum = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        assert_true(((const float *)frame.radiance.texels)[4 * i + 3] > 0);
        sum += (double)((const float *)frame.radiance.texels)[4 * i + 1] / (EXTENT * EXTENT);
    }
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return sum;
}

/// The cosine is 1/2: twice as many tiles along the view as across.
static void radiance_stays_over_a_zoom(void **state) {
    fixture *f = *state;
    const double angle = M_PI / 3;
    const picture_request truth = {.filter = "reference",
                                   .settings = {"displacement=geometry"},
                                   .width = EXTENT,
                                   .height = EXTENT,
                                   .samples = 8};
    const picture_request request = {.filter = "leadr",
                                     .settings = {"displacement=geometry", "pixels_per_vertex=8"},
                                     .width = EXTENT,
                                     .height = EXTENT};
    const double expected = mean_of(f, angle, 1, &truth);
    for (double tiles = 1; tiles <= 64; tiles *= 2) {
        const double found = mean_of(f, angle, tiles, &request);
        print_message("# %g tiles: %.4f\n", tiles, found / expected);
        if (fabs(found / expected - 1) > 0.047)
            fail_msg("%g tiles across: %g instead of %g", tiles, found, expected);
    }
}

// ---------------------------------------------------------------------------------------------
// A flight

enum { WIDTH = 128, HEIGHT = 72, PIXELS = WIDTH * HEIGHT, FRAMES = 6 };

/// Changes of the pixels' green from one frame to the next.
typedef struct frame_change {
    double pixels[PIXELS];
    double largest; ///< radiance
} frame_change;

/// Towards a point that is seen 68 degrees from above: `octaves` halve the distance so often.
static lobe_frame frame_at(fixture *f, const char *name, double octaves, uint32_t samples,
                           uint32_t pattern) {
    const double distance = 6 * exp2(-octaves), angle = 68 * M_PI / 180;
    const lobe_filter *filter = filter_named(name);
    const lobe_settings settings =
        settings_of(filter, (const char *const[]){"displacement=geometry", NULL});
    const lobe_camera camera = {
        .eye = {(float)octaves, (float)(distance * cos(angle)), (float)(distance * sin(angle))},
        .target = {0.05f, 0, 0},
        .up = {0, 1, 0},
        .vertical_field_of_view = 0.4f,
        .near_plane = 0.01f};
    lobe_frame frame;
    const lobe_render_parameters parameters = {
        .filter = filter,
        .settings = &settings,
        .width = WIDTH,
        .height = HEIGHT,
        .camera = &camera,
        .reference = {.samples = samples, .pattern = pattern},
    };
    assert_int_equal(lobe_renderer_render(f->renderer, &parameters, &frame), LOBE_OK);
    return frame;
}

static void change_at(fixture *f, const char *name, double octaves, double step, uint32_t pattern,
                      frame_change *change) {
    enum { SAMPLES = 4 };
    lobe_frame before = frame_at(f, name, octaves, SAMPLES, pattern);
    lobe_frame after = frame_at(f, name, octaves + step, SAMPLES, pattern);
    change->largest = 0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        const double value = (double)((const float *)after.radiance.texels)[4 * i + 1];
        change->pixels[i] = value - (double)((const float *)before.radiance.texels)[4 * i + 1];
        change->largest = fmax(change->largest, value);
    }
    lobe_frame_free(&before);
    lobe_frame_free(&after);
}

/// Of changes of two pictures whose grain differs.
static double root_mean_product(const frame_change *a, const frame_change *b) {
    double sum = 0;
    for (uint32_t i = 0; i < PIXELS; i++)
        sum += a->pixels[i] * b->pixels[i] / PIXELS;
    return sqrt(fmax(sum, 0));
}

/// 1.2 times nearer in 6 frames. A hundredth of a step would show what jumps.
static void print_flight(fixture *f, const char *name, lobe_image map, double scale) {
    const double step = 0.25 / FRAMES;
    lobe_scene *scene = plane_of(map, (float)scale, 60, &(lobe_camera){.up = {0, 1, 0}});
    frame_change own, small, truth[2];
    double beyond = -INFINITY, jump = 0, squares[2] = {0};
    hold_scene(f, scene);
    for (int i = 0; i < FRAMES; i++) {
        change_at(f, "leadr", i * step, step, 0, &own);
        change_at(f, "leadr", i * step, step / 100, 0, &small);
        change_at(f, "reference", i * step, step, 0, &truth[0]);
        change_at(f, "reference", i * step, step, 1, &truth[1]);
        const double peak = truth[0].largest, found = root_mean_product(&own, &own) / peak,
                     expected = root_mean_product(&truth[0], &truth[1]) / peak;
        squares[0] += found * found / FRAMES;
        squares[1] += expected * expected / FRAMES;
        beyond = fmax(beyond, found - expected);
        jump = fmax(jump, root_mean_product(&small, &small) / peak);
    }
    printf("%s: changes of a frame, over the reference's largest radiance: %.4f, reference's %.4f, "
           "beyond these at most %.4f; of a hundredth of a frame at most %.4f\n",
           name, sqrt(squares[0]), sqrt(squares[1]), beyond, jump);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

/// Slopes of a root mean square of 0.5 each way, as those of the relief made here.
static void print_flight_over_file(fixture *f, const char *path) {
    lobe_image map = sample_relief_load(path, &f->host);
    const double range = sample_relief_normalise(&map);
    print_flight(f, path, map, sqrt(0.5) * range / map.width);
}

static void print_flights(int count, char **names) {
    void *state = NULL;
    fixture_create(&state);
    for (int i = 0; i < count; i++) {
        float scale;
        if (strcmp(names[i], "flight") != 0) {
            print_flight_over_file(state, names[i]);
            continue;
        }
        lobe_image waves = gaussian_heights(MAP, 0.5, 11, &scale);
        print_flight(state, "waves", waves, (double)scale);
    }
    fixture_destroy(&state);
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(radiance_stays_over_a_zoom)};
    if (count < 2)
        return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
    print_flights(count - 1, arguments + 1);
    return 0;
}
