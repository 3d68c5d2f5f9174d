// The references of the passes themselves: clustering, mixtures and the reduction of any size.

#include <math.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/mixture/lobe_mixture.h"

// An arbitrary lobe that differs from texel to texel.
static reference_lobe lobe_at(uint32_t x, uint32_t y, double share) {
    double tilt = 0.2 + 0.9 * fabs(sin(1.7 * x + 0.3 * y)), azimuth = 2.1 * x + 3.7 * y;
    return (reference_lobe){{sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt)},
                            4 + 30 * fabs(cos(0.9 * x - 1.3 * y)),
                            share};
}

// Two lobes a texel; every fifth texel is left out where `holes` is set.
static reference_layers make_mixture(uint32_t width, uint32_t height, int holes) {
    reference_layers mixture = reference_layers_allocate(width, height, REFERENCE_MIXTURE_LAYERS);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            if (holes && (x + 2 * y) % 5 == 0)
                continue;
            reference_lobe first = lobe_at(x, y, 0.75), second = lobe_at(y + 7, x + 3, 0.25);
            reference_add_lobe(&mixture, x, y, &first);
            reference_add_lobe(&mixture, x, y, &second);
            reference_add_normal(&mixture, x, y, (double[]){0, 0, 1});
        }
    }
    return mixture;
}

static void assert_near(double actual, double expected, double tolerance) {
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%.17g instead of %.17g", actual, expected);
}

static void reduce_in_place(reference_layers *layers) {
    reference_layers reduced = reference_reduce(layers);
    reference_layers_free(layers);
    *layers = reduced;
}

static void check_chain(uint32_t width, uint32_t height) {
    double means[4 * REFERENCE_MIXTURE_LAYERS];
    reference_layers layers = make_mixture(width, height, 1);
    reference_mean(&layers, means);
    while (layers.width > 1 || layers.height > 1) {
        uint32_t expected_width = layers.width > 1 ? layers.width / 2 : 1;
        reduce_in_place(&layers);
        assert_int_equal(layers.width, expected_width);
    }
    for (int i = 0; i < 4 * REFERENCE_MIXTURE_LAYERS; i++)
        assert_near(layers.texels[i], means[i], 1e-14);
    reference_layers_free(&layers);
}

static void reduction_keeps_the_mean_at_any_size(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1},  {1, 7},   {7, 1},  {2, 2},   {3, 3},    {13, 8},
                                        {31, 1}, {64, 32}, {5, 96}, {67, 45}, {671, 457}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        check_chain(sizes[i][0], sizes[i][1]);
}

static void odd_sizes_take_three_texels(void **state) {
    (void)state;
    // Five texels to two: weights 2, 2, 1 and 1, 2, 2 fifths.
    static const double expected[2][5] = {{0.4, 0.4, 0.2, 0, 0}, {0, 0, 0.2, 0.4, 0.4}};
    for (uint32_t j = 0; j < 2; j++)
        for (uint32_t i = 0; i < 5; i++)
            assert_near(reference_box_weight(i, 5, j), expected[j][i], 1e-15);
}

static void check_sum(const reference_layers *mixture, uint32_t whole, uint32_t first,
                      uint32_t count) {
    for (int channel = 0; channel < 4; channel++) {
        double sum = 0;
        for (uint32_t i = 0; i < count; i++)
            sum += reference_texel(mixture, 0, 0, first + i)[channel];
        assert_near(sum, reference_texel(mixture, 0, 0, whole)[channel], 1e-14);
    }
}

static void clusters_add_up(void **state) {
    (void)state;
    reference_layers mixture = make_mixture(16, 16, 1);
    for (int level = 0; level < 4; level++)
        reduce_in_place(&mixture);
    check_sum(&mixture, REFERENCE_MIXTURE_LAYER_ONE, REFERENCE_MIXTURE_LAYER_SECTORS, 4);
    for (uint32_t i = 0; i < 4; i++)
        check_sum(&mixture, REFERENCE_MIXTURE_LAYER_SECTORS + i,
                  REFERENCE_MIXTURE_LAYER_HALVES + 2 * i, 2);
    reference_layers_free(&mixture);
}

// Midpoints in the cosine and the azimuth, each of the same area.
static double integrate(const reference_layers *mixture, uint32_t subdivision) {
    enum { HEIGHTS = 300, AZIMUTHS = 40 };
    double sum = 0;
    for (int i = 0; i < HEIGHTS * AZIMUTHS; i++) {
        double z = 2 * (i / AZIMUTHS + 0.5) / HEIGHTS - 1;
        double azimuth = 2 * M_PI * (i % AZIMUTHS) / AZIMUTHS, radius = sqrt(1 - z * z);
        const double direction[3] = {radius * cos(azimuth), radius * sin(azimuth), z};
        sum += reference_evaluate_mixture(mixture, 0, 0, subdivision, direction);
    }
    return sum * 4 * M_PI / (HEIGHTS * AZIMUTHS);
}

static void mixtures_integrate_to_their_coverage(void **state) {
    (void)state;
    reference_layers mixture = make_mixture(9, 5, 1);
    while (mixture.width > 1 || mixture.height > 1)
        reduce_in_place(&mixture);
    double coverage = reference_texel(&mixture, 0, 0, REFERENCE_MIXTURE_LAYER_ONE)[3];
    assert_near(coverage, 36 / 45.0, 1e-14);
    for (uint32_t subdivision = 0; subdivision <= 2; subdivision++)
        assert_near(integrate(&mixture, subdivision), coverage, 1e-4);
    reference_layers_free(&mixture);
}

static void one_lobe_comes_back(void **state) {
    (void)state;
    reference_layers mixture = reference_layers_allocate(1, 1, REFERENCE_MIXTURE_LAYERS);
    const reference_lobe lobe = {{0.36, -0.48, 0.8}, 57, 1};
    const double direction[3] = {0.48, -0.36, 0.8};
    reference_add_lobe(&mixture, 0, 0, &lobe);
    double expected = reference_von_mises_fisher(direction, lobe.axis, 57);
    for (uint32_t subdivision = 0; subdivision <= 2; subdivision++) {
        double actual = reference_evaluate_mixture(&mixture, 0, 0, subdivision, direction);
        assert_near(actual, expected, 1e-10);
    }
    double complement = reference_texel(&mixture, 0, 0, REFERENCE_MIXTURE_LAYER_MEAN)[3];
    assert_near(complement, reference_mean_resultant_complement(57), 1e-15);
    reference_layers_free(&mixture);
}

static void nothing_is_no_lobe(void **state) {
    (void)state;
    reference_layers mixture = reference_layers_allocate(1, 1, REFERENCE_MIXTURE_LAYERS);
    assert_true(reference_evaluate_mixture(&mixture, 0, 0, 2, (double[]){0, 0, 1}) == 0);
    // Opposite lobes leave no direction: a uniform lobe.
    double *texel = reference_texel(&mixture, 0, 0, REFERENCE_MIXTURE_LAYER_ONE);
    texel[3] = 0.5;
    double value = reference_evaluate_mixture(&mixture, 0, 0, 0, (double[]){0, 0, 1});
    assert_near(value, 0.5 / (4 * M_PI), 1e-15);
    reference_layers_free(&mixture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(odd_sizes_take_three_texels),
        cmocka_unit_test(reduction_keeps_the_mean_at_any_size),
        cmocka_unit_test(clusters_add_up),
        cmocka_unit_test(mixtures_integrate_to_their_coverage),
        cmocka_unit_test(one_lobe_comes_back),
        cmocka_unit_test(nothing_is_no_lobe),
    };
    return cmocka_run_group_tests_name("lobe_mixture", tests, NULL, NULL);
}
