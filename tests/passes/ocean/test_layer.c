// Amplitudes of waves against the spectrum's integrals.
//
// `test_ocean_layer slopes` prints, for winds and fetches from the least to the greatest, what four
// seas have of the variance of slopes in each layer's band.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "passes/ocean/layer.h"

#define PI 3.14159265358979323846

static lobe_ocean_parameters parameters_of(uint32_t size) {
    lobe_ocean_parameters parameters;
    lobe_ocean_default(&parameters);
    parameters.size = size;
    parameters.wind_direction = 0.7f;
    return parameters;
}

static float *amplitudes_of(const ocean_layer *layer, const sea *sea) {
    float *amplitudes = calloc((size_t)2 * layer->size * layer->size, sizeof *amplitudes);
    assert_non_null(amplitudes);
    passes_ocean_layer_amplitudes(layer, sea, amplitudes);
    return amplitudes;
}

static int32_t number(uint32_t place, uint32_t size) {
    return place < size / 2 ? (int32_t)place : (int32_t)place - (int32_t)size;
}

/// The covariance of the slopes of one sea: each pair of opposite waves counts twice.
static void add_slopes(const ocean_layer *layer, const float *amplitudes, double covariance[3]) {
    const double step = 2 * PI / layer->length;
    for (uint32_t y = 0; y < layer->size; y++)
        for (uint32_t x = 0; x < layer->size; x++, amplitudes += 2) {
            const double kx = step * number(x, layer->size), ky = step * number(y, layer->size);
            const double part = 2 * (pow(amplitudes[0], 2) + pow(amplitudes[1], 2));
            covariance[0] += part * kx * kx;
            covariance[1] += part * ky * ky;
            covariance[2] += part * kx * ky;
        }
}

/// The mean covariance of four seas, and the spectrum's integral over the waves of a layer that
/// texels can hold.
static void slopes_of_layer(const lobe_ocean_parameters *parameters, uint32_t index,
                            double found[3], double exact[3]) {
    const sea sea = passes_sea(parameters);
    double along_across[2];
    ocean_layer layer = passes_ocean_layer(parameters, index);
    layer.to = fmin(layer.to, 0.99 * PI * layer.size / layer.length);
    memset(found, 0, 3 * sizeof *found);
    for (uint32_t seed = 1; seed <= 4; seed++) {
        layer.seed = seed;
        float *amplitudes = amplitudes_of(&layer, &sea);
        add_slopes(&layer, amplitudes, found);
        free(amplitudes);
    }
    for (int k = 0; k < 3; k++)
        found[k] /= 4;
    passes_sea_slopes(&sea, layer.from, layer.to, along_across);
    passes_sea_covariance(&sea, along_across, exact);
}

// The mean of four seas is within 3 % of the spectrum's integral.
static void slopes_are_those_of_the_spectrum(void **state) {
    (void)state;
    lobe_ocean_parameters parameters = parameters_of(1024);
    for (uint32_t i = 0; i < parameters.layers; i++) {
        double found[3], exact[3];
        slopes_of_layer(&parameters, i, found, exact);
        for (int k = 0; k < 3; k++)
            assert_true(fabs(found[k] - exact[k]) < 0.03 * (exact[0] + exact[1]) / 2);
        assert_true(fabs((found[0] + found[1]) / (exact[0] + exact[1]) - 1) < 0.03);
    }
}

/// In brackets, how much of the slopes of all of the sea is in the layer.
static void print_slopes(float wind, float fetch) {
    lobe_ocean_parameters parameters = parameters_of(1024);
    parameters.wind_speed = wind;
    parameters.fetch = fetch;
    const sea sea = passes_sea(&parameters);
    double all[2];
    passes_sea_slopes(&sea, 0, INFINITY, all);
    printf("%5g m/s %8g km", (double)wind, (double)fetch / 1000);
    for (uint32_t i = 0; i < parameters.layers; i++) {
        double found[3], exact[3];
        slopes_of_layer(&parameters, i, found, exact);
        printf(" %7.3f (%.3f)", (found[0] + found[1]) / (exact[0] + exact[1]),
               (exact[0] + exact[1]) / (all[0] + all[1]));
    }
    printf("\n");
}

static void bands_are_disjoint_and_complete(void **state) {
    (void)state;
    const lobe_ocean_parameters parameters = parameters_of(64);
    double last = 0;
    for (uint32_t i = 0; i < parameters.layers; i++) {
        const ocean_layer layer = passes_ocean_layer(&parameters, i);
        assert_true(layer.from == last && layer.to > layer.from);
        last = layer.to;
    }
    assert_true(isinf(last));
}

// The waves of a larger table are those of a smaller one, and more.
static void waves_do_not_depend_on_the_size(void **state) {
    (void)state;
    const lobe_ocean_parameters coarse = parameters_of(32), fine = parameters_of(128);
    const ocean_layer a = passes_ocean_layer(&coarse, 2), b = passes_ocean_layer(&fine, 2);
    const sea sea = passes_sea(&coarse);
    float *few = amplitudes_of(&a, &sea), *many = amplitudes_of(&b, &sea);
    size_t above_zero = 0;
    for (int32_t m = -15; m < 16; m++)
        for (int32_t n = -15; n < 16; n++) {
            const size_t i = (size_t)(m & 31) * 32 + (size_t)(n & 31);
            const size_t k = (size_t)(m & 127) * 128 + (size_t)(n & 127);
            assert_memory_equal(few + 2 * i, many + 2 * k, 2 * sizeof *few);
            above_zero += few[2 * i] != 0;
        }
    assert_true(above_zero > 300);
    // Nyquist's row and column have a sign that depends on where texels lie.
    for (size_t i = 0; i < 32; i++)
        assert_true(few[2 * (16 * 32 + i)] == 0 && few[2 * (i * 32 + 16)] == 0);
    free(few);
    free(many);
}

// Real and imaginary parts, of seas with other seeds, are independent normal numbers.
static void amplitudes_are_normal(void **state) {
    (void)state;
    enum { SEEDS = 4000 };
    lobe_ocean_parameters parameters = parameters_of(8);
    const sea sea = passes_sea(&parameters);
    double square = 0, fourth = 0, mixed = 0, neighbours = 0;
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        parameters.seed = seed;
        const ocean_layer layer = passes_ocean_layer(&parameters, 0);
        float values[2 * 8 * 8];
        passes_ocean_layer_amplitudes(&layer, &sea, values);
        const double a = values[2 * 9], b = values[2 * 9 + 1], c = values[2 * 10];
        square += a * a + b * b;
        fourth += a * a * a * a + b * b * b * b;
        mixed += a * b;
        neighbours += a * c;
    }
    const double variance = square / (2 * SEEDS);
    assert_true(variance > 0);
    assert_true(fabs(fourth / (2 * SEEDS) / (variance * variance) - 3) < 0.3);
    assert_true(fabs(mixed / SEEDS) < 0.06 * variance);
    assert_true(fabs(neighbours / SEEDS) < 0.1 * variance);
}

// Whatever the size, layers and rest are the whole sea; interpolation takes its part.
static void what_layers_lack_is_the_rest(void **state) {
    (void)state;
    double last = 0;
    for (uint32_t size = 8; size <= 512; size *= 2) {
        const lobe_ocean_parameters parameters = parameters_of(size);
        lobe_ocean_slopes slopes;
        assert_int_equal(lobe_ocean_measure(&parameters, NULL, &slopes), LOBE_OK);
        double sum[3], captured = 0;
        for (int k = 0; k < 3; k++) {
            sum[k] = slopes.rest[k];
            for (uint32_t i = 0; i < parameters.layers; i++)
                sum[k] += slopes.layers[i][k];
            assert_true(fabs(sum[k] - slopes.total[k]) < 1e-6);
        }
        for (uint32_t i = 0; i < parameters.layers; i++)
            captured += slopes.layers[i][0] + slopes.layers[i][1];
        assert_true(captured > last);
        last = captured;
    }
    assert_true(last > 0.03 && last < 0.05);
}

static void assert_refused(lobe_ocean_parameters parameters) {
    lobe_ocean_slopes slopes;
    assert_int_equal(lobe_ocean_measure(&parameters, NULL, &slopes), LOBE_ERROR_INVALID_ARGUMENT);
    assert_true(slopes.total[0] == 0);
}

static void nonsense_is_refused(void **state) {
    (void)state;
    const lobe_ocean_parameters good = parameters_of(64);
    lobe_ocean_parameters bad = good;
    bad.wind_speed = NAN;
    assert_refused(bad);
    bad.wind_speed = 61;
    assert_refused(bad);
    bad = good;
    bad.wind_direction = INFINITY;
    assert_refused(bad);
    bad = good;
    bad.fetch = 0;
    assert_refused(bad);
    bad = good;
    bad.size = 96;
    assert_refused(bad);
    bad.size = 2048;
    assert_refused(bad);
    bad = good;
    bad.layers = 0;
    assert_refused(bad);
    bad.layers = 4;
    assert_refused(bad);
    bad = good;
    bad.lengths[1] = 400;
    assert_refused(bad);
    bad.lengths[1] = NAN;
    assert_refused(bad);
    bad = good;
    bad.choppiness = -1;
    assert_refused(bad);
    bad = good;
    bad.spectrum = (lobe_ocean_spectrum)7;
    assert_refused(bad);
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_are_those_of_the_spectrum),
        cmocka_unit_test(bands_are_disjoint_and_complete),
        cmocka_unit_test(waves_do_not_depend_on_the_size),
        cmocka_unit_test(amplitudes_are_normal),
        cmocka_unit_test(what_layers_lack_is_the_rest),
        cmocka_unit_test(nonsense_is_refused),
    };
    if (count < 2 || strcmp(arguments[1], "slopes") != 0)
        return cmocka_run_group_tests(tests, NULL, NULL);
    static const float winds[] = {1, 5, 10, 20, 60}, fetches[] = {1e3f, 1e6f, 1e8f};
    for (size_t i = 0; i < sizeof winds / sizeof *winds; i++)
        for (size_t k = 0; k < sizeof fetches / sizeof *fetches; k++)
            print_slopes(winds[i], fetches[k]);
    return 0;
}
