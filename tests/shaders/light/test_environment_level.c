// shaders/lib/light/environment_level.glsl: levels against what they are derived from.

#include <math.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "light/environment_level.comp";
enum { LEVELS, SHARE, BLEND, PREFILTERED };

enum { COUNT = 600 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static double clamped(double value, double high) {
    return fmin(fmax(value, 0), high);
}

/// A texel of the level covers, on average, the requested solid angle.
static void test_solid_angle(void **state) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){
            {(float)(16 << i % 8), (float)geometric(1e-7, 20, i, COUNT)}, {0}, {0}};
    harness_evaluate(state, shader, LEVELS, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double width = arguments[i].a[0], texels = 4 * M_PI / arguments[i].a[1];
        double level = clamped(0.5 * log2(6 * width * width / texels), log2(width));
        check_close("solid_angle_level", &arguments[i], results[i].value[1], level, 1e-5);
    }
}

/// Integral of cos^s over the hemisphere.
static double power_solid_angle(double exponent) {
    enum { PANELS = 40 };
    static quadrature_node nodes[PANELS * QUADRATURE_ORDER];
    geometric_quadrature(1e-6, 1, PANELS, nodes);
    double sum = 0;
    for (size_t i = 0; i < PANELS * QUADRATURE_ORDER; i++)
        sum += nodes[i].weight * 2 * M_PI * pow(1 - nodes[i].x, exponent);
    return sum;
}

/// McGuire's level: a texel covers as much as the lobe does.
static void test_mip_level(void **state) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){
            {(float)(16 << i % 8), (float)geometric(1e-3, 1e6, i, COUNT)}, {0}, {0}};
    harness_evaluate(state, shader, LEVELS, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double width = arguments[i].a[0], covered = power_solid_angle(arguments[i].a[1]);
        double level = clamped(0.5 * log2(6 * width * width * covered / (4 * M_PI)), log2(width));
        check_close("mip_level", &arguments[i], results[i].value[0], level, 1e-4);
    }
}

/// The value of a von Mises-Fisher lobe at its own direction.
static double peak(double kappa) {
    return kappa > 0 ? kappa / (-2 * M_PI * expm1(-2 * kappa)) : 1 / (4 * M_PI);
}

/// Squared L2 distance over the sphere of a blend of two lobes from a third.
static double blend_error(double share, const float lobes[3]) {
    enum { PANELS = 40 };
    static quadrature_node nodes[PANELS * QUADRATURE_ORDER];
    geometric_quadrature(0.01 / fmax(lobes[0], 1), 2, PANELS, nodes);
    double sum = 0;
    for (size_t i = 0; i < PANELS * QUADRATURE_ORDER; i++) {
        double value[3];
        for (int k = 0; k < 3; k++)
            value[k] = peak(lobes[k]) * exp(-lobes[k] * nodes[i].x);
        double difference = share * value[0] + (1 - share) * value[1] - value[2];
        sum += nodes[i].weight * 2 * M_PI * difference * difference;
    }
    return sum;
}

/// The minimum of a parabola through three points.
static double best_share(const float lobes[3]) {
    double at_0 = blend_error(0, lobes), at_half = blend_error(0.5, lobes);
    double at_1 = blend_error(1, lobes);
    return 0.5 - 0.25 * (at_1 - at_0) / (at_0 - 2 * at_half + at_1);
}

static void test_best_blend(void **state) {
    for (size_t i = 0; i < COUNT; i++) {
        double broader = i % 10 == 0 ? 0 : geometric(0.25, 1e5, i, COUNT);
        double sharper = i % 10 == 0 ? 0.25 : 4 * broader;
        double between = broader + (sharper - broader) * (double)(i % 7) / 6;
        arguments[i] =
            (harness_arguments){{(float)sharper, (float)broader, (float)between}, {0}, {0}};
    }
    harness_evaluate(state, shader, SHARE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        check_close("sharper_share", &arguments[i], results[i].value[0], best_share(arguments[i].a),
                    2e-4);
    report_worst_error("sharper_share");
}

/// Each level is chosen for its own concentration, and concentrations in between give levels in
/// between.
static void test_prefiltered_level(void **state) {
    const double width = 256;
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){
            {(float)width, (float)geometric(1e-3, 4096, i, COUNT), 0, 256}, {0}, {0}};
    for (int level = 0; level < 8; level++)
        arguments[level] = (harness_arguments){
            {(float)width, (float)(4096 / pow(4, level)), (float)level, 256}, {0}, {0}};
    harness_evaluate(state, shader, PREFILTERED, arguments, COUNT, results);
    for (int level = 0; level < 8; level++) {
        check_close("prefiltered_level", &arguments[level], results[level].value[0], level, 1e-3);
        check_close("prefiltered_concentration", &arguments[level], results[level].value[1],
                    arguments[level].a[1], 1e-3);
    }
    for (size_t i = 8; i < COUNT; i++) {
        double exact = 0.5 * log2(4096 / arguments[i].a[1]), level = results[i].value[0];
        assert_true(level >= fmin(floor(exact - 1e-4), 7) - 1e-3);
        assert_true(level <= fmin(ceil(exact + 1e-4), 8) + 1e-3);
        assert_true(results[i].value[2] == 0);
        if (i > 8)
            assert_true(level <= results[i - 1].value[0] + 1e-3);
    }
}

static double concentration_of(double width, double level) {
    double texels = width / exp2(level);
    return texels > 1.5 ? texels * texels / 16 : 0;
}

/// Relative L2 distance of a blend from the lobe that it approximates.
static double relative_error(double share, double first, double second, double lobe) {
    const float lobes[3] = {(float)first, (float)second, (float)lobe};
    const float nothing[3] = {0, 0, (float)lobe};
    double uniform = 1 / (4 * M_PI);
    // |lobe|^2 = |lobe - uniform|^2 + |uniform|^2, since both have the same integral.
    return sqrt(blend_error(share, lobes) / (blend_error(0, nothing) + uniform));
}

/// Trilinear interpolation is at most 13.2 % off a lobe, with the cube in between 3.6 %.
static void test_blends_are_near(void **state) {
    const double width = 256;
    double worst[2] = {0};
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] = (harness_arguments){
            {(float)width, (float)geometric(1e-3, 4096, i, COUNT), 0, 256}, {0}, {0}};
    harness_evaluate(state, shader, PREFILTERED, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        double level = fmin(floor(results[i].value[0]), 7);
        worst[0] =
            fmax(worst[0],
                 relative_error(level + 1 - results[i].value[0], concentration_of(width, level),
                                concentration_of(width, level + 1), arguments[i].a[1]));
    }
    harness_evaluate(state, shader, BLEND, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++)
        worst[1] = fmax(worst[1], relative_error(results[i].value[2],
                                                 concentration_of(width, results[i].value[0]),
                                                 2 * concentration_of(width, results[i].value[1]),
                                                 arguments[i].a[1]));
    assert_true(worst[0] < 0.132 && worst[0] > 0.12);
    assert_true(worst[1] < 0.036 && worst[1] > 0.03);
}

/// Beyond the finest level the radiance takes over, up to all of it.
static void test_radiance_takes_over(void **state) {
    for (size_t i = 0; i < COUNT; i++)
        arguments[i] =
            (harness_arguments){{256, (float)geometric(4096, 1e6, i, COUNT), 0, 256}, {0}, {0}};
    harness_evaluate(state, shader, PREFILTERED, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        assert_true(results[i].value[0] <= 1e-3);
        if (i > 0)
            assert_true(results[i].value[2] >= results[i - 1].value[2] - 1e-5);
    }
    assert_true(results[0].value[2] < 1e-3);
    assert_true(results[COUNT - 1].value[2] > 0.999);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solid_angle),     cmocka_unit_test(test_mip_level),
        cmocka_unit_test(test_best_blend),      cmocka_unit_test(test_prefiltered_level),
        cmocka_unit_test(test_blends_are_near), cmocka_unit_test(test_radiance_takes_over),
    };
    return cmocka_run_group_tests(tests, harness_set_up, harness_tear_down);
}
