// Spectra of the sea against closed forms, published figures and brute-force integrals.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "passes/ocean/sea.h"

#define PI 3.14159265358979323846

static sea sea_of(lobe_ocean_spectrum spectrum, double wind, double fetch) {
    lobe_ocean_parameters parameters;
    lobe_ocean_default(&parameters);
    parameters.spectrum = spectrum;
    parameters.wind_speed = (float)wind;
    parameters.fetch = (float)fetch;
    return passes_sea(&parameters);
}

static double slope_variance(const sea *sea) {
    double along_across[2];
    passes_sea_slopes(sea, 0, INFINITY, along_across);
    return along_across[0] + along_across[1];
}

static void assert_within(double value, double expected, double part) {
    if (!(fabs(value - expected) <= part * fabs(expected)))
        fail_msg("%g; expected %g", value, expected);
}

// Long waves of gravity travel at g/omega; the slowest waves are those of 17 mm, at 23 cm/s.
static void waves_disperse(void **state) {
    (void)state;
    const double k = 0.01, omega = passes_sea_frequency(k);
    assert_within(omega / k, SEA_GRAVITY / omega, 1e-8);
    double slowest = INFINITY, at = 0;
    for (double length = 0.005; length < 0.1; length += 1e-5) {
        const double number = 2 * PI / length, speed = passes_sea_frequency(number) / number;
        at = speed < slowest ? length : at;
        slowest = fmin(slowest, speed);
    }
    assert_within(slowest, 0.23, 0.005);
    assert_within(at, 0.017, 0.005);
}

// Cox, Munk 1954, Measurement of the Roughness of the Sea Surface from Photographs of the Sun's
// Glitter: 0.003 + 0.00512 U for clean water, with a scatter of 0.004. Elfouhaily's spectrum lies
// above that.
static void slopes_are_those_of_cox_and_munk(void **state) {
    (void)state;
    for (double wind = 3; wind <= 14; wind += 1) {
        const sea sea = sea_of(LOBE_OCEAN_ELFOUHAILY, wind, 1e7);
        assert_within(slope_variance(&sea), 0.003 + 0.00512 * wind + 0.004, 0.07);
    }
    const sea sea = sea_of(LOBE_OCEAN_ELFOUHAILY, 10, 1e7);
    double along_across[2];
    passes_sea_slopes(&sea, 0, INFINITY, along_across);
    // 0.00316 U along the wind, 0.003 + 0.00192 U across it.
    assert_within(along_across[0] / along_across[1], 0.0316 / 0.0222, 0.05);
}

// The variance of heights: Pierson and Moskowitz's shape has alpha g^2/(5 omega_p^4), the peak
// raises it by 1/(1 - 0.287 log 3.3) (DNV 2010, Recommended Practice C205, section 3.5.5).
static void jonswap_grows_with_the_fetch(void **state) {
    (void)state;
    for (double fetch = 1e4; fetch < 3e5; fetch *= 3) {
        const sea sea = sea_of(LOBE_OCEAN_JONSWAP, 12, fetch);
        double variance = 0;
        for (double k = 1e-4; k < 60; k *= 1.002)
            variance += passes_sea_elevation(&sea, k) * k * log(1.002);
        const double scale = 0.076 * pow(144 / (fetch * SEA_GRAVITY), 0.22);
        const double peak = 22 * cbrt(SEA_GRAVITY * SEA_GRAVITY / (12 * fetch));
        const double exact =
            scale * pow(SEA_GRAVITY, 2) / (5 * pow(peak, 4)) / (1 - 0.287 * log(3.3));
        assert_within(variance, exact, 0.02);
    }
}

// Its integral over frequencies has a closed form: alpha g^2/(4 beta omega_0^4).
static void pierson_and_moskowitz_have_their_height(void **state) {
    (void)state;
    for (double wind = 2; wind <= 50; wind *= 2) {
        const sea sea = sea_of(LOBE_OCEAN_PIERSON_MOSKOWITZ, wind, 1e3);
        double variance = 0;
        for (double k = 1e-6; k < 60; k *= 1.002)
            variance += passes_sea_elevation(&sea, k) * k * log(1.002);
        const double origin = SEA_GRAVITY / (1.026 * wind);
        const double exact = 8.1e-3 * SEA_GRAVITY * SEA_GRAVITY / (4 * 0.74 * pow(origin, 4));
        assert_within(variance, exact, 3e-3);
    }
}

// As a second, independent implementation found them: mean square slopes at 5, 10 and 15 m/s, of
// Elfouhaily's spectrum (with another constant of the logarithmic law) and of JONSWAP's after
// 100 km.
static void slopes_are_those_of_others(void **state) {
    (void)state;
    static const double elfouhaily[] = {0.0316, 0.0603, 0.0843},
                        jonswap[] = {0.0214, 0.0314, 0.0391};
    for (int i = 0; i < 3; i++) {
        const sea grown = sea_of(LOBE_OCEAN_ELFOUHAILY, 5 * (i + 1), 1e7);
        const sea young = sea_of(LOBE_OCEAN_JONSWAP, 5 * (i + 1), 1e5);
        assert_within(slope_variance(&grown), elfouhaily[i], 0.025);
        assert_within(slope_variance(&young), jonswap[i], 0.005);
    }
}

static void directions_add_up(void **state) {
    (void)state;
    enum { STEPS = 20000 };
    for (int spreading = 0; spreading < 2; spreading++) {
        sea sea = sea_of(LOBE_OCEAN_ELFOUHAILY, 8, 1e6);
        sea.spreading = (lobe_ocean_spreading)spreading;
        for (double k = sea.peak / 2; k < 400; k *= 5) {
            double sum = 0, aligned = 0;
            for (int i = 0; i < STEPS; i++) {
                const double angle = -PI + (i + 0.5) * 2 * PI / STEPS;
                const double part = passes_sea_spread(&sea, k, angle) * 2 * PI / STEPS;
                assert_true(part >= 0);
                sum += part;
                aligned += part * cos(angle) * cos(angle);
            }
            assert_within(sum, 1, 1e-3);
            assert_within(aligned, passes_sea_alignment(&sea, k), 1e-3);
        }
        // Nothing travels against the wind.
        assert_true(passes_sea_spread(&sea, sea.peak, 3.1) < 1e-6);
    }
}

// Over the plane of wave vectors, with the wind at an angle.
static void slopes_are_those_of_the_plane(void **state) {
    (void)state;
    sea sea = sea_of(LOBE_OCEAN_ELFOUHAILY, 7, 1e6);
    sea.direction = 0.6;
    const double from = 0.5, to = 9;
    double sums[3] = {0}, along_across[2], covariance[3];
    for (double k = from; k < to; k *= 1.005)
        for (int i = 0; i < 720; i++) {
            const double middle = k * sqrt(1.005), angle = (i + 0.5) * 2 * PI / 720;
            const double x = middle * cos(angle), y = middle * sin(angle);
            const double part = passes_sea_density(&sea, x, y) * middle * k * 0.005 * 2 * PI / 720;
            sums[0] += part * x * x;
            sums[1] += part * y * y;
            sums[2] += part * x * y;
        }
    passes_sea_slopes(&sea, from, to, along_across);
    passes_sea_covariance(&sea, along_across, covariance);
    for (int i = 0; i < 3; i++)
        assert_within(sums[i], covariance[i], 0.01);
}

static void calm_and_storm_have_numbers(void **state) {
    (void)state;
    for (int spectrum = 0; spectrum < 3; spectrum++)
        for (double wind = 0; wind <= 60; wind += 0.5) {
            const sea sea = sea_of((lobe_ocean_spectrum)spectrum, wind, wind < 30 ? 1e3 : 1e8);
            const double variance = slope_variance(&sea);
            assert_true(variance >= 0 && variance < 0.6);
            assert_true(wind > 0 || variance == 0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_disperse),
        cmocka_unit_test(slopes_are_those_of_cox_and_munk),
        cmocka_unit_test(jonswap_grows_with_the_fetch),
        cmocka_unit_test(pierson_and_moskowitz_have_their_height),
        cmocka_unit_test(slopes_are_those_of_others),
        cmocka_unit_test(directions_add_up),
        cmocka_unit_test(slopes_are_those_of_the_plane),
        cmocka_unit_test(calm_and_storm_have_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
