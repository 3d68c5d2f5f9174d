// shaders/lib/displacement/transfer_basis.glsl: orthonormal, and integrated as by quadrature;
// transfer_light.glsl: the same from moments of light.

#include <math.h>
#include <string.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/samples.h"

enum { AZIMUTHS = 12, NODES = QUADRATURE_ORDER, COUNT = AZIMUTHS * NODES, FUNCTIONS = 16 };

static harness_arguments arguments[COUNT];
static harness_result results[4][COUNT];

static double value(size_t i, int k) {
    return (double)results[k / 4][i].value[k % 4];
}

static void evaluate(void **state, uint32_t first, size_t count) {
    for (uint32_t i = 0; i < 4; i++)
        harness_evaluate(state, "displacement/transfer_basis.comp", first + i, arguments, count,
                         results[i]);
}

/// Products of degree 8 in z, and of six periods around the pole: exact.
static void polynomials_are_orthonormal(void **state) {
    static const double integrals[FUNCTIONS] = {[0] = 2.1708037636748028,
                                                [3] = -0.9341652027329882,
                                                [8] = 0.5526595869963785,
                                                [15] = -0.3759942411946501};
    quadrature_node nodes[NODES];
    gauss_legendre(0, 1, nodes);
    for (size_t i = 0; i < COUNT; i++) {
        const double z = nodes[i / AZIMUTHS].x, azimuth = 2 * M_PI * (i % AZIMUTHS) / AZIMUTHS;
        const double across = sqrt(1 - z * z);
        arguments[i] = (harness_arguments){
            .a = {(float)(across * cos(azimuth)), (float)(across * sin(azimuth)), (float)z}};
    }
    evaluate(state, 0, COUNT);
    for (int j = 0; j < FUNCTIONS; j++) {
        double integral = 0;
        for (int k = 0; k <= j; k++) {
            double product = 0;
            for (size_t i = 0; i < COUNT; i++)
                product +=
                    nodes[i / AZIMUTHS].weight * 2 * M_PI / AZIMUTHS * value(i, j) * value(i, k);
            check_close("product", arguments, product, j == k, 1e-5);
        }
        for (size_t i = 0; i < COUNT; i++)
            integral += nodes[i / AZIMUTHS].weight * 2 * M_PI / AZIMUTHS * value(i, j);
        check_close("integral", arguments, integral, integrals[j], 1e-5);
    }
    report_worst_error("polynomials");
}

static void below_the_horizon_they_are_nothing(void **state) {
    arguments[0] = (harness_arguments){.a = {0.6F, 0, -0.8F}};
    evaluate(state, 0, 1);
    for (int k = 0; k < FUNCTIONS; k++)
        assert_true(value(0, k) == 0);
}

/// Of random facets and horizons, against quadrature of the polynomials themselves.
static void azimuths_are_integrated(void **state) {
    enum { CASES = 60 };
    static double expected[CASES][FUNCTIONS];
    static harness_arguments cases[CASES];
    uint64_t random = 5;
    for (int i = 0; i < CASES; i++) {
        const double slope = i % 4 == 0 ? 0 : pow(10, scenes_random_between(&random, -2, 1.5)),
                     azimuth = scenes_random_between(&random, 0, 2 * M_PI);
        float normal[3];
        random_direction(&random, normal);
        const double towards = normal[0], up = fabs((double)normal[2]);
        cases[i] = (harness_arguments){
            .a = {(float)slope, (float)cos(azimuth), (float)sin(azimuth), (float)towards},
            .b = {(float)up, 0.5F}};
        quadrature_node nodes[NODES];
        gauss_legendre(atan(slope), M_PI / 2, nodes);
        for (int j = 0; j < NODES; j++) {
            const double s = sin(nodes[j].x), c = cos(nodes[j].x);
            arguments[j] = (harness_arguments){
                .a = {(float)(c * cos(azimuth)), (float)(c * sin(azimuth)), (float)s}};
        }
        evaluate(state, 0, NODES);
        for (int j = 0; j < NODES; j++) {
            const double s = sin(nodes[j].x), c = cos(nodes[j].x);
            for (int k = 0; k < FUNCTIONS; k++)
                expected[i][k] +=
                    0.5 * nodes[j].weight * c * (towards * c + up * s) * value((size_t)j, k);
        }
    }
    memcpy(arguments, cases, sizeof cases);
    evaluate(state, 4, CASES);
    for (size_t i = 0; i < CASES; i++)
        for (int k = 0; k < FUNCTIONS; k++)
            check_close("azimuth", &arguments[i], value(i, k), expected[i][k], 4e-5);
    report_worst_error("azimuths");
}

/// In random frames, mirrored ones among them.
static void moments_of_light_give_its_polynomials(void **state) {
    static double expected[COUNT][FUNCTIONS];
    uint64_t random = 11;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        random_direction(&random, arguments[i].b);
        random_direction(&random, arguments[i].c);
        arguments[i].c[3] = i % 2 ? 1 : -1;
    }
    evaluate(state, 12, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        for (int k = 0; k < FUNCTIONS; k++)
            expected[i][k] = value(i, k);
    evaluate(state, 8, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        for (int k = 0; k < FUNCTIONS; k++)
            check_close("light", &arguments[i], value(i, k), expected[i][k], 2e-5);
    report_worst_error("light");
}

static void products_of_coordinates_give_them_too(void **state) {
    static double expected[COUNT][FUNCTIONS];
    uint64_t random = 5;
    for (size_t i = 0; i < COUNT; i++) {
        random_direction(&random, arguments[i].a);
        arguments[i].a[2] = fabsf(arguments[i].a[2]);
    }
    evaluate(state, 0, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        for (int k = 0; k < FUNCTIONS; k++)
            expected[i][k] = value(i, k);
    evaluate(state, 16, COUNT);
    for (size_t i = 0; i < COUNT; i++)
        for (int k = 0; k < FUNCTIONS; k++)
            check_close("products", &arguments[i], value(i, k) * (double)arguments[i].a[2],
                        expected[i][k], 5e-5);
    report_worst_error("products");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polynomials_are_orthonormal),
        cmocka_unit_test(below_the_horizon_they_are_nothing),
        cmocka_unit_test(azimuths_are_integrated),
        cmocka_unit_test(moments_of_light_give_its_polynomials),
        cmocka_unit_test(products_of_coordinates_give_them_too),
    };
    return cmocka_run_group_tests_name("transfer_basis", tests, harness_set_up, harness_tear_down);
}
