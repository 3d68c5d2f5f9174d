// shaders/lib/microfacet/microfacet.glsl: closed forms, reciprocity, and the weak white furnace.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "tests/engine/support/cmocka_all.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/shaders/support/check.h"
#include "tests/shaders/support/harness.h"
#include "tests/shaders/support/quadrature.h"
#include "tests/shaders/support/samples.h"

static const char shader[] = "microfacet/microfacet.comp";
enum { SPECULAR, DIFFUSE, FRAME, VISIBLE_AREA };

enum { COUNT = 2000, DISTRIBUTIONS = 4 };
static harness_arguments arguments[COUNT];
static harness_result results[COUNT];

static void test_specular(void **state) {
    uint64_t random = 13;
    for (size_t i = 0; i < COUNT; i++) {
        for (int j = 0; j < 3; j++)
            arguments[i].a[j] = (float)random_number(&random);
        arguments[i].b[0] = (float)geometric(1e-6, 1e6, i, COUNT);
        arguments[i].b[1] = (float)random_number(&random);
        arguments[i].b[2] = i < 4 ? 0 : (float)geometric(1e-8, 1, (i * 7) % COUNT, COUNT);
    }
    harness_evaluate(state, shader, SPECULAR, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        const float *b = arguments[i].b;
        for (int j = 0; j < 3; j++)
            check_relative("microfacet_specular", &arguments[i], results[i].value[j],
                           reference_microfacet_specular(arguments[i].a[j], b[0], b[1], b[2]),
                           10 * FLOAT_ROUNDING);
    }
    report_worst_error("microfacet_specular");
}

static void test_diffuse(void **state) {
    uint64_t random = 14;
    for (size_t i = 0; i < COUNT; i++) {
        for (int j = 0; j < 3; j++) {
            arguments[i].a[j] = (float)random_number(&random);
            arguments[i].b[j] = (float)random_number(&random);
        }
        arguments[i].c[0] = (float)scenes_random_between(&random, -1, 1);
    }
    harness_evaluate(state, shader, DIFFUSE, arguments, COUNT, results);
    for (size_t i = 0; i < COUNT; i++) {
        for (int j = 0; j < 3; j++) {
            const harness_arguments *at = &arguments[i];
            check_relative("microfacet_diffuse", at, results[i].value[j],
                           reference_microfacet_diffuse(at->a[j], at->b[j], at->c[0]),
                           10 * FLOAT_ROUNDING);
        }
    }
    report_worst_error("microfacet_diffuse");
}

static float parameter_at(uint32_t distribution, double alpha) {
    bool slope = distribution <= LOBE_DISTRIBUTION_BECKMANN;
    return (float)(slope ? alpha : 2 / (alpha * alpha));
}

static void random_upper_direction(uint64_t *random, float direction[3]) {
    random_direction(random, direction);
    direction[2] = fmaxf(fabsf(direction[2]), 1e-3f);
}

// Helmholtz: the reflectance, which is the frame's value over the incident cosine, is the same
// with both directions exchanged.
static void test_reciprocity(void **state) {
    static harness_arguments exchanged[COUNT];
    static harness_result other[COUNT];
    uint64_t random = 15;
    for (size_t i = 0; i < COUNT; i++) {
        harness_arguments *at = &arguments[i];
        random_upper_direction(&random, at->a);
        random_upper_direction(&random, at->b);
        at->c[0] = (float)(i % DISTRIBUTIONS);
        at->c[1] = parameter_at(i % DISTRIBUTIONS, geometric(0.02, 1, i, COUNT));
        at->c[2] = (float)random_number(&random);
        exchanged[i] = *at;
        for (int j = 0; j < 3; j++) {
            exchanged[i].a[j] = at->b[j];
            exchanged[i].b[j] = at->a[j];
        }
    }
    harness_evaluate(state, shader, FRAME, arguments, COUNT, results);
    harness_evaluate(state, shader, FRAME, exchanged, COUNT, other);
    size_t bright = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double there = results[i].value[0] / arguments[i].b[2];
        double back = other[i].value[0] / arguments[i].a[2];
        bright += there > 1e-3;
        // The half vector is the same; <omega_i, h> and <omega_o, h> are rounded differently.
        check_relative("reciprocity", &arguments[i], there, back, 3e-6);
    }
    assert_true(bright > COUNT / 4);
    report_worst_error("reciprocity");
}

// Integral over the hemisphere of D(h) G1(omega_o) max(<omega_o, h>, 0) / <n, omega_o> dh.
enum { PANELS = 20, RINGS = PANELS * QUADRATURE_ORDER, NODES = RINGS * QUADRATURE_ORDER };

// Half the range of azimuths about omega_o at which a facet tilted by theta faces it: the integrand
// is smooth within.
static double facing_azimuth(double theta, double outgoing_theta) {
    double cosine = -1 / (tan(theta) * tan(outgoing_theta));
    return cosine <= -1 ? M_PI : cosine >= 1 ? 0 : acos(cosine);
}

static double visible_area(void **state, uint32_t distribution, double alpha, double theta) {
    static harness_arguments calls[NODES];
    static harness_result values[NODES];
    static double weights[NODES];
    quadrature_node rings[RINGS], azimuths[QUADRATURE_ORDER];
    geometric_quadrature(0.2 * alpha, M_PI / 2, PANELS, rings);
    for (size_t i = 0; i < NODES; i++) {
        const quadrature_node *ring = &rings[i / QUADRATURE_ORDER];
        gauss_legendre(0, facing_azimuth(ring->x, theta), azimuths);
        const quadrature_node *azimuth = &azimuths[i % QUADRATURE_ORDER];
        double radius = sin(ring->x);
        calls[i] = (harness_arguments){{(float)sin(theta), 0, (float)cos(theta)},
                                       {(float)(radius * cos(azimuth->x)),
                                        (float)(radius * sin(azimuth->x)), (float)cos(ring->x)},
                                       {(float)distribution, parameter_at(distribution, alpha)}};
        weights[i] = 2 * ring->weight * azimuth->weight * radius;
    }
    harness_evaluate(state, shader, VISIBLE_AREA, calls, NODES, values);
    double area = 0;
    for (size_t i = 0; i < NODES; i++)
        area += weights[i] * values[i].value[0];
    return area;
}

// Heitz, 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, Eq. 14: the
// facets that a direction sees cover the surface exactly.
static void test_weak_white_furnace(void **state) {
    static const double alphas[] = {0.01, 0.05, 0.2, 0.5, 1};
    static const double angles[] = {0.01, 0.5, 1.0, 1.3, 1.5};
    for (uint32_t distribution = 0; distribution <= LOBE_DISTRIBUTION_BECKMANN; distribution++) {
        for (size_t i = 0; i < 25; i++) {
            double area = visible_area(state, distribution, alphas[i / 5], angles[i % 5]);
            // Of Lambda 1e-5, see test_masking; the rest is the quadrature's and rounding near
            // the horizon.
            check_close("weak white furnace", &(harness_arguments){{0}, {0}, {0}}, area, 1, 3e-5);
        }
    }
    report_worst_error("weak white furnace");
}

// Blinn-Phong and von Mises-Fisher are masked as if they were Beckmann (Walter et al. 2007, section
// 5.2), which is approximate: the smoother, the closer.
static void test_weak_white_furnace_of_borrowed_masking(void **state) {
    static const double angles[] = {0.01, 0.5, 1.0, 1.3};
    for (uint32_t distribution = LOBE_DISTRIBUTION_BLINN_PHONG;
         distribution <= LOBE_DISTRIBUTION_VMF; distribution++) {
        for (size_t i = 0; i < 4; i++) {
            const harness_arguments at = {{(float)distribution, (float)angles[i]}, {0}, {0}};
            check_close("weak white furnace, alpha 0.05", &at,
                        visible_area(state, distribution, 0.05, angles[i]), 1, 2e-3);
            check_close("weak white furnace, alpha 0.3", &at,
                        visible_area(state, distribution, 0.3, angles[i]), 1, 0.05);
        }
    }
    report_worst_error("weak white furnace of borrowed masking");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_specular),
        cmocka_unit_test(test_diffuse),
        cmocka_unit_test(test_reciprocity),
        cmocka_unit_test(test_weak_white_furnace),
        cmocka_unit_test(test_weak_white_furnace_of_borrowed_masking),
    };
    return cmocka_run_group_tests_name("microfacet", tests, harness_set_up, harness_tear_down);
}
