// The maps of a sea against sums over its waves in double precision.

#include "tests/passes/support/fixture.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/ocean.h>

#include "passes/ocean/layer.h"

#define PI 3.14159265358979323846
enum { CHANNELS = 8 };

typedef double complex number;

static lobe_ocean_parameters parameters_of(uint32_t size) {
    lobe_ocean_parameters parameters;
    lobe_ocean_default(&parameters);
    parameters.size = size;
    parameters.wind_direction = -0.4f;
    return parameters;
}

/// Two planes of four channels for each layer; the caller frees them.
static float *maps_of(fixture *f, const lobe_ocean_parameters *parameters, double seconds) {
    lobe_ocean *ocean;
    assert_int_equal(lobe_ocean_create(f->device, parameters, &f->host, &ocean), LOBE_OK);
    lobe_graph_begin(f->graph);
    const lobe_resource maps = lobe_ocean_add(ocean, f->graph, seconds);
    lobe_graph_read_back(f->graph, maps, (lobe_range){0});
    assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
    size_t size;
    const void *data = lobe_graph_data(f->graph, maps, &size);
    assert_int_equal(size, (size_t)32 * parameters->size * parameters->size * parameters->layers);
    float *copy = malloc(size);
    memcpy(copy, data, size);
    lobe_graph_begin(f->graph);
    lobe_ocean_destroy(&ocean);
    return copy;
}

/// One of the eight channels of a texel.
static double channel(const float *maps, uint32_t size, uint32_t layer, uint32_t x, uint32_t y,
                      uint32_t index) {
    const size_t plane = 2 * layer + index / 4;
    return maps[4 * ((plane * size + y) * size + x) + index % 4];
}

// ---------------------------------------------------------------------------------------------
// The reference

/// Each wave travels on its own: its real part and the derivatives of that.
static void sum_waves(const ocean_layer *layer, const float *amplitudes, double choppiness,
                      double x, double y, double seconds, double sums[CHANNELS]) {
    const int32_t half = (int32_t)layer->size / 2;
    memset(sums, 0, CHANNELS * sizeof *sums);
    for (int32_t m = -half; m < half; m++)
        for (int32_t n = -half; n < half; n++) {
            const size_t i =
                (size_t)(m & (2 * half - 1)) * layer->size + (size_t)(n & (2 * half - 1));
            const double kx = 2 * PI * n / layer->length, ky = 2 * PI * m / layer->length;
            const double k = hypot(kx, ky);
            if (k == 0)
                continue;
            const number wave = 2 * (amplitudes[2 * i] + I * amplitudes[2 * i + 1]) *
                                cexp(I * (kx * x + ky * y - passes_sea_frequency(k) * seconds));
            const number moved = choppiness * I * wave / k;
            sums[0] += creal(wave);
            sums[1] += creal(kx * moved);
            sums[2] += creal(ky * moved);
            sums[3] += creal(I * ky * kx * moved);
            sums[4] += creal(I * kx * wave);
            sums[5] += creal(I * ky * wave);
            sums[6] += creal(I * kx * kx * moved);
            sums[7] += creal(I * ky * ky * moved);
        }
}

static void compare_layer(const lobe_ocean_parameters *parameters, uint32_t index,
                          const float *maps, double seconds) {
    const uint32_t size = parameters->size;
    const sea sea = passes_sea(parameters);
    const ocean_layer layer = passes_ocean_layer(parameters, index);
    float *amplitudes = calloc((size_t)2 * size * size, sizeof *amplitudes);
    passes_ocean_layer_amplitudes(&layer, &sea, amplitudes);
    double errors[CHANNELS] = {0}, squares[CHANNELS] = {0};
    for (uint32_t y = 0; y < size; y += 3)
        for (uint32_t x = 0; x < size; x += 3) {
            double sums[CHANNELS];
            sum_waves(&layer, amplitudes, parameters->choppiness, x * layer.length / size,
                      y * layer.length / size, seconds, sums);
            for (uint32_t i = 0; i < CHANNELS; i++) {
                errors[i] += pow(channel(maps, size, index, x, y, i) - sums[i], 2);
                squares[i] += sums[i] * sums[i];
            }
        }
    // Frequencies are whole numbers of turns in 65536 s: at most half of one is missing.
    const double limit = 1e-5 + PI * seconds / 65536;
    for (uint32_t i = 0; i < CHANNELS; i++)
        assert_true(squares[i] > 0 && errors[i] <= limit * limit * squares[i]);
    free(amplitudes);
}

static void maps_are_sums_of_waves(void **state) {
    static const double times[] = {0, 1.5, 17.25, 100};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        const lobe_ocean_parameters parameters = parameters_of(32);
        float *maps = maps_of(*state, &parameters, times[i]);
        for (uint32_t layer = 0; layer < parameters.layers; layer++)
            compare_layer(&parameters, layer, maps, times[i]);
        free(maps);
    }
}

// ---------------------------------------------------------------------------------------------
// Time

/// The Fourier coefficient of heights at a wave vector of whole numbers.
static number coefficient(const float *maps, uint32_t size, uint32_t layer, int n, int m) {
    number sum = 0;
    for (uint32_t y = 0; y < size; y++)
        for (uint32_t x = 0; x < size; x++)
            sum += channel(maps, size, layer, x, y, 0) *
                   cexp(-2 * PI * I * (n * (double)x + m * (double)y) / size);
    return sum / ((double)size * size);
}

// Over its period, a wave turns once, and forwards: along the wind, which blows along x.
static void waves_travel_as_they_should(void **state) {
    lobe_ocean_parameters parameters = parameters_of(64);
    parameters.wind_direction = 0;
    parameters.layers = 1;
    for (int n = 3; n < 12; n += 4) {
        const double frequency = passes_sea_frequency(2 * PI * n / parameters.lengths[0]);
        const double period = 2 * PI / frequency;
        float *before = maps_of(*state, &parameters, 40);
        float *later = maps_of(*state, &parameters, 40 + period / 4);
        float *again = maps_of(*state, &parameters, 40 + period);
        const number first = coefficient(before, 64, 0, n, 0);
        assert_true(cabs(first) > 1e-4);
        assert_true(cabs(coefficient(later, 64, 0, n, 0) + I * first) < 2e-3 * cabs(first));
        assert_true(cabs(coefficient(again, 64, 0, n, 0) - first) < 2e-3 * cabs(first));
        free(before);
        free(later);
        free(again);
    }
}

static void waves_repeat_to_the_bit(void **state) {
    const lobe_ocean_parameters parameters = parameters_of(64);
    float *first = maps_of(*state, &parameters, 1234.5);
    float *second = maps_of(*state, &parameters, 1234.5);
    float *other = maps_of(*state, &parameters, 1234.75);
    const size_t size = (size_t)32 * 64 * 64 * parameters.layers;
    assert_memory_equal(first, second, size);
    assert_true(memcmp(first, other, size) != 0);
    free(first);
    free(second);
    free(other);
}

static void same_time_runs_nothing(void **state) {
    fixture *f = *state;
    const lobe_ocean_parameters parameters = parameters_of(16);
    static const struct {
        double seconds;
        size_t runs; ///< of `spectrum`
    } frames[] = {{1, 1}, {1, 0}, {2, 1}, {2, 0}};
    lobe_ocean *ocean;
    assert_int_equal(lobe_ocean_create(f->device, &parameters, &f->host, &ocean), LOBE_OK);
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        lobe_graph_begin(f->graph);
        lobe_graph_output(f->graph, lobe_ocean_add(ocean, f->graph, frames[i].seconds));
        assert_int_equal(lobe_graph_execute(f->graph), LOBE_OK);
        assert_int_equal(count_passes(f->graph, "spectrum", LOBE_PASS_RUN), frames[i].runs);
    }
    lobe_graph_begin(f->graph);
    lobe_ocean_destroy(&ocean);
}

// ---------------------------------------------------------------------------------------------
// Variance

/// The covariance of slopes of a layer's texels.
static void slopes_of(const float *maps, uint32_t size, uint32_t layer, double covariance[3]) {
    memset(covariance, 0, 3 * sizeof *covariance);
    for (uint32_t y = 0; y < size; y++)
        for (uint32_t x = 0; x < size; x++) {
            const double sx = channel(maps, size, layer, x, y, 4),
                         sy = channel(maps, size, layer, x, y, 5);
            covariance[0] += sx * sx / size / size;
            covariance[1] += sy * sy / size / size;
            covariance[2] += sx * sy / size / size;
        }
}

// Of four seas; Parseval's theorem says that texels have what amplitudes have (see test_layer.c).
static void variances_are_those_of_the_amplitudes(void **state) {
    lobe_ocean_parameters parameters = parameters_of(128);
    const sea sea = passes_sea(&parameters);
    float *amplitudes = calloc((size_t)2 * 128 * 128, sizeof *amplitudes);
    for (parameters.seed = 1; parameters.seed <= 4; parameters.seed++) {
        float *maps = maps_of(*state, &parameters, 5 * parameters.seed);
        for (uint32_t i = 0; i < parameters.layers; i++) {
            const ocean_layer layer = passes_ocean_layer(&parameters, i);
            passes_ocean_layer_amplitudes(&layer, &sea, amplitudes);
            double found[3], heights = 0, expected = 0, slopes = 0;
            slopes_of(maps, 128, i, found);
            for (uint32_t y = 0; y < 128; y++)
                for (uint32_t x = 0; x < 128; x++) {
                    heights += pow(channel(maps, 128, i, x, y, 0), 2) / 128 / 128;
                    const size_t at = 2 * (y * 128 + x);
                    const double n = x < 64 ? x : x - 128.0, m = y < 64 ? y : y - 128.0;
                    const double part = 2 * (pow(amplitudes[at], 2) + pow(amplitudes[at + 1], 2));
                    expected += part;
                    slopes += part * (n * n + m * m) * pow(2 * PI / layer.length, 2);
                }
            assert_true(fabs(heights / expected - 1) < 1e-5);
            assert_true(fabs((found[0] + found[1]) / slopes - 1) < 1e-5);
        }
        free(maps);
    }
    free(amplitudes);
}

// lobe_ocean_measure says what linear waves have: the slopes of the moved surface, each as often as
// its place is seen, have nearly the same variance.
static void choppiness_hardly_changes_slopes(void **state) {
    const lobe_ocean_parameters parameters = parameters_of(256);
    float *maps = maps_of(*state, &parameters, 3);
    for (uint32_t layer = 0; layer < parameters.layers; layer++) {
        double moved = 0, linear = 0, total = 0;
        for (uint32_t y = 0; y < 256; y++)
            for (uint32_t x = 0; x < 256; x++) {
                double v[CHANNELS];
                for (uint32_t i = 0; i < CHANNELS; i++)
                    v[i] = channel(maps, 256, layer, x, y, i);
                const double area = (1 + v[6]) * (1 + v[7]) - v[3] * v[3];
                const double sx = (1 + v[7]) * v[4] - v[3] * v[5],
                             sy = (1 + v[6]) * v[5] - v[3] * v[4];
                assert_true(area > 0);
                moved += (sx * sx + sy * sy) / area;
                linear += v[4] * v[4] + v[5] * v[5];
                total += area;
            }
        if (!(fabs(moved / total / (linear / 65536) - 1) < 0.05))
            fail_msg("layer %u: %g of %g", layer, moved / total, linear / 65536);
    }
    free(maps);
}

// Points move towards crests, and are closer together there; choppiness scales how far.
static void crests_are_sharp(void **state) {
    lobe_ocean_parameters parameters = parameters_of(64);
    float *maps = maps_of(*state, &parameters, 3);
    parameters.choppiness = 0.5f;
    float *half = maps_of(*state, &parameters, 3);
    for (uint32_t layer = 0; layer < parameters.layers; layer++) {
        double together = 0, area = 0;
        for (uint32_t y = 0; y < 64; y++)
            for (uint32_t x = 0; x < 64; x++) {
                double v[CHANNELS];
                for (uint32_t i = 0; i < CHANNELS; i++)
                    v[i] = channel(maps, 64, layer, x, y, i);
                together += v[0] * (v[6] + v[7]);
                area += ((1 + v[6]) * (1 + v[7]) - v[3] * v[3]) / 64 / 64;
                assert_true(fabs(channel(half, 64, layer, x, y, 1) - 0.5 * v[1]) < 1e-5);
                assert_true(channel(half, 64, layer, x, y, 4) == v[4]);
            }
        assert_true(together < 0);
        assert_true(fabs(area - 1) < 1e-4);
    }
    free(maps);
    free(half);
}

// ---------------------------------------------------------------------------------------------
// Extremes

static void extremes_have_numbers(void **state) {
    static const struct {
        float wind, length;
        uint32_t size;
    } seas[] = {{0, 512, 8}, {50, 512, 8}, {50, 1, 256}, {3, 1e5f, 64}, {60, 20, 1024}};
    for (size_t i = 0; i < sizeof seas / sizeof *seas; i++) {
        lobe_ocean_parameters parameters = parameters_of(seas[i].size);
        parameters.wind_speed = seas[i].wind;
        parameters.layers = 1;
        parameters.lengths[0] = seas[i].length;
        float *maps = maps_of(*state, &parameters, 65535.99);
        double squares = 0;
        for (size_t k = 0; k < (size_t)8 * seas[i].size * seas[i].size; k++) {
            assert_true(isfinite(maps[k]));
            squares += maps[k] * maps[k];
        }
        assert_true((squares > 0) == (seas[i].wind > 0));
        free(maps);
    }
}

static void nonsense_fails_in_one_line(void **state) {
    fixture *f = *state;
    static const double times[] = {-1, 65536, INFINITY, NAN};
    lobe_ocean_parameters parameters = parameters_of(16);
    lobe_ocean *ocean;
    assert_int_equal(lobe_ocean_create(f->device, &parameters, &f->host, &ocean), LOBE_OK);
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        fixture_forget_messages(f);
        lobe_graph_begin(f->graph);
        lobe_ocean_add(ocean, f->graph, times[i]);
        assert_failure(f, lobe_graph_execute(f->graph), LOBE_ERROR_INVALID_ARGUMENT,
                       "expected 0 to 65536");
    }
    lobe_graph_begin(f->graph);
    lobe_ocean_destroy(&ocean);
    lobe_ocean_destroy(&ocean);
    parameters.fetch = NAN;
    fixture_forget_messages(f);
    assert_failure(f, lobe_ocean_create(f->device, &parameters, &f->host, &ocean),
                   LOBE_ERROR_INVALID_ARGUMENT, "fetch");
    assert_null(ocean);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_are_sums_of_waves),
        cmocka_unit_test(waves_travel_as_they_should),
        cmocka_unit_test(waves_repeat_to_the_bit),
        cmocka_unit_test(same_time_runs_nothing),
        cmocka_unit_test(variances_are_those_of_the_amplitudes),
        cmocka_unit_test(choppiness_hardly_changes_slopes),
        cmocka_unit_test(crests_are_sharp),
        cmocka_unit_test(extremes_have_numbers),
        cmocka_unit_test(nonsense_fails_in_one_line),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
