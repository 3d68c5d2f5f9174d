// Waves on a plane, seen from far away, against the displaced surface: rays meet the first of its
// points, and others find out whether the sun reaches it.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include <lobe/ocean.h>

#include "tests/passes/maps/wave_fields.h"
#include "tests/passes/support/scene_builder.h"

enum { RELIEF = 128 };
#define RELIEF_LENGTH 61.0

/// The longest waves of a sea, twice as high as they are, without choppiness.
static void make_relief(fixture *f, lobe_image images[2]) {
    lobe_ocean_parameters sea;
    lobe_ocean *ocean;
    lobe_ocean_default(&sea);
    sea.size = RELIEF;
    sea.wind_direction = 0.5f;
    sea.wind_speed = 20;
    sea.choppiness = 0;
    sea.layers = 2;
    sea.lengths[0] = RELIEF_LENGTH;
    sea.lengths[1] = 24;
    assert_int_equal(lobe_ocean_create(f->device, &sea, &f->host, &ocean), LOBE_OK);
    lobe_graph_begin(f->graph);
    const lobe_resource maps = lobe_ocean_add(ocean, f->graph, 0);
    lobe_graph_read_back(f->graph, maps, (lobe_range){0});
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
    const float *data = lobe_graph_data(f->graph, maps, NULL);
    for (uint32_t i = 0; i < 2; i++) {
        images[i] = map_image(LOBE_FORMAT_RGBA32_FLOAT, RELIEF, RELIEF);
        for (size_t k = 0; k < (size_t)4 * RELIEF * RELIEF; k++)
            ((float *)images[i].texels)[k] = 2 * data[(size_t)4 * RELIEF * RELIEF * i + k];
    }
    lobe_graph_begin(f->graph);
    lobe_ocean_destroy(&ocean);
}

static double height_at(const lobe_image images[2], const double p[3]) {
    double place[4];
    wave_field_at(&images[0], p[0] * RELIEF / RELIEF_LENGTH, p[1] * RELIEF / RELIEF_LENGTH, place);
    return place[0];
}

/// From a point along a direction, up or down: the first point below the surface; false if it
/// leaves the range of heights before.
static bool march(const lobe_image images[2], double p[3], const double direction[3],
                  double highest) {
    const double step = 0.12 / hypot(direction[0], direction[1]);
    for (int i = 0; i < 4000; i++) {
        for (int k = 0; k < 3; k++)
            p[k] += step * direction[k];
        if (p[2] < height_at(images, p))
            return true;
        if (p[2] > highest)
            return false;
    }
    return false;
}

/// What facets whose slopes vary by `variance` about the surface's own reflect of a sun, of a white
/// metal: radiance in the direction `o`, for an irradiance of one perpendicular to `i`.
static double facet_radiance(const lobe_image images[2], const double p[3], const double o[3],
                             const double i[3], double variance) {
    double g[4];
    wave_field_at(&images[1], p[0] * RELIEF / RELIEF_LENGTH, p[1] * RELIEF / RELIEF_LENGTH, g);
    const double h[3] = {o[0] + i[0], o[1] + i[1], o[2] + i[2]};
    const double half[2] = {-h[0] / h[2], -h[1] / h[2]}, mean[2] = {g[0], g[1]};
    const double cosine = h[2] / sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    const double seen = o[2] - g[0] * o[0] - g[1] * o[1];
    if (seen <= 0 || i[2] - g[0] * i[0] - g[1] * i[1] <= 0)
        return 0;
    return slope_density_at(half, mean, (double[]){variance, variance, 0}) / pow(cosine, 4) /
           (4 * seen);
}

/// The mean radiance of the displaced surface over a picture: of each point of the picture, the
/// first of the surface that is met, if the sun reaches it.
static double relief_radiance(const lobe_image images[2], const double o[3], const double i[3],
                              double variance) {
    enum { POINTS_ACROSS = 120 };
    double highest = 0, sum = 0;
    for (size_t k = 0; k < (size_t)RELIEF * RELIEF; k++)
        highest = fmax(highest, ((const float *)images[0].texels)[4 * k]);
    const double back[3] = {-o[0], -o[1], -o[2]};
    for (int y = 0; y < POINTS_ACROSS; y++)
        for (int x = 0; x < POINTS_ACROSS; x++) {
            double p[3] = {(x + 0.5) * RELIEF_LENGTH / POINTS_ACROSS,
                           (y + 0.5) * RELIEF_LENGTH / POINTS_ACROSS, highest};
            assert_true(march(images, p, back, INFINITY));
            double q[3] = {p[0], p[1], height_at(images, p) + 0.05};
            if (!march(images, q, i, highest))
                sum += facet_radiance(images, p, o, i, variance);
        }
    return sum / (POINTS_ACROSS * POINTS_ACROSS);
}

static void relief_slopes(const lobe_image images[2], float covariance[3]) {
    double sums[3] = {0};
    for (int y = 0; y < 4 * RELIEF; y++)
        for (int x = 0; x < 4 * RELIEF; x++) {
            double g[4];
            wave_field_at(&images[1], (x + 0.5) / 4, (y + 0.5) / 4, g);
            sums[0] += g[0] * g[0];
            sums[1] += g[1] * g[1];
            sums[2] += g[0] * g[1];
        }
    for (int k = 0; k < 3; k++)
        covariance[k] = (float)(sums[k] / (16.0 * RELIEF * RELIEF));
}

// From far away, waves on a plane look as the displaced surface does, with all that it hides and
// shadows: its slopes are nearly Gaussian, and Smith's masking errs by a few per cent.
static void far_sea_is_that_of_a_displaced_one(void **state) {
    // In the tangent frame, (+X, -Z, +Y) of the world.
    static const struct {
        double viewer, sun, turn; ///< degrees above the horizon; of the sun, away from opposite
    } views[] = {{60, 60, 0}, {30, 40, 10}, {12, 30, 0}, {12, 12, 5}};
    fixture *f = *state;
    lobe_image images[2];
    wave_fields given;
    const double variance = 0.5 * pow(0.3, 4);
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.3, 1);
    material.waves = (lobe_waves){.layers = 1, .size = RELIEF, .lengths = {1}};
    make_relief(f, images);
    relief_slopes(images, material.waves.total);
    wave_fields_upload(f, images, &given);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        const double up = views[i].viewer * M_PI / 180, high = views[i].sun * M_PI / 180,
                     turn = views[i].turn * M_PI / 180;
        const double o[3] = {cos(up), 0, sin(up)},
                     towards[3] = {-cos(high) * cos(turn), cos(high) * sin(turn), sin(high)};
        const double expected = relief_radiance(images, o, towards, variance);
        const double seen =
            wave_fields_seen_from(f, &material, &given, (double[]){o[0], o[2], -o[1]},
                                  (double[]){towards[0], towards[2], -towards[1]});
        if (!(fabs(seen / expected - 1) < 0.1))
            fail_msg("from %g degrees: %g, expected %g", views[i].viewer, seen, expected);
    }
    wave_fields_free(&given);
    for (uint32_t i = 0; i < 2; i++)
        lobe_image_free(&images[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(far_sea_is_that_of_a_displaced_one),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
