// Lobes shared out to components in single precision, against double precision: any number of
// lobes and components, far from each other and near, with weights of all sizes.

#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <string.h>

#include "passes/filters/moments/lobe_columns.h"
#include "scenes/builtin/random.h"
#include "shaders/interface/moment_bins.h"

enum { MOST = SURVEY_TEXELS };

/// A set of lobes and components, which lie within `spread` of the middle and are `size` wide.
typedef struct column_case {
    uint32_t samples, components;
    double spread, size;
} column_case;

static const column_case cases[] = {
    {1, 1, 0.5, 0.3}, {63, 2, 0.5, 0.3},  {64, 3, 0.8, 0.1},   {65, 6, 0.3, 1},
    {777, 4, 1, 0.5}, {MOST, 6, 1, 0.05}, {129, 2, 0.9, 0.01},
};

static void fill(const column_case *c, plane_sample *samples, lobe_chance *chances) {
    random_sequence sequence = scenes_random_start(c->samples + 7 * c->components);
    for (uint32_t i = 0; i < c->samples; i++) {
        samples[i] = (plane_sample){.variance = scenes_random_between(&sequence, 0, 0.2),
                                    .weight = pow(10, scenes_random_between(&sequence, -3, 3))};
        for (int j = 0; j < 2; j++)
            samples[i].place[j] = scenes_random_between(&sequence, -c->spread, c->spread);
    }
    for (uint32_t k = 0; k < c->components; k++) {
        lobe_chance *chance = &chances[k];
        *chance = (lobe_chance){.offset = (float)scenes_random_between(&sequence, -3, 3)};
        for (int j = 0; j < 2; j++) {
            chance->mean[j] = (float)scenes_random_between(&sequence, -c->spread, c->spread);
            chance->squares[j] = (float)(scenes_random_between(&sequence, 0.5, 1) / c->size);
        }
        chance->squares[2] = (float)scenes_random_between(&sequence, -0.4, 0.4) / (float)c->size;
    }
}

static double logarithm_of(const lobe_chance *c, const plane_sample *sample, double d[2]) {
    for (int j = 0; j < 2; j++)
        d[j] = sample->place[j] - (double)c->mean[j];
    return (double)c->offset -
           ((double)c->squares[0] * d[0] * d[0] + (double)c->squares[1] * d[1] * d[1] +
            2 * (double)c->squares[2] * d[0] * d[1]) -
           ((double)c->squares[0] + (double)c->squares[1]) * sample->variance;
}

static double share(const column_case *c, const plane_sample *samples, const lobe_chance *chances,
                    plane_sums *sums) {
    double likelihood = 0, total = 0;
    for (uint32_t i = 0; i < c->samples; i++)
        total += samples[i].weight;
    for (uint32_t i = 0; i < c->samples; i++) {
        double logarithms[MOMENT_MAXIMUM_BINS], d[MOMENT_MAXIMUM_BINS][2], most = -INFINITY,
                                                                           sum = 0;
        for (uint32_t k = 0; k < c->components; k++) {
            logarithms[k] = logarithm_of(&chances[k], &samples[i], d[k]);
            most = fmax(most, logarithms[k]);
        }
        for (uint32_t k = 0; k < c->components; k++)
            sum += exp(logarithms[k] - most);
        likelihood += samples[i].weight / total * (most + log(sum));
        for (uint32_t k = 0; k < c->components; k++) {
            const double own = samples[i].weight / total * exp(logarithms[k] - most) / sum;
            sums[k].weight += own;
            sums[k].variance += own * samples[i].variance;
            for (int j = 0; j < 2; j++) {
                sums[k].place[j] += own * d[k][j];
                sums[k].moments[j] += own * d[k][j] * d[k][j];
            }
            sums[k].moments[2] += own * d[k][0] * d[k][1];
        }
    }
    return likelihood;
}

static void assert_near(double value, double expected, double scale) {
    if (!(fabs(value - expected) <= 2e-5 * scale))
        fail_msg("%.9g instead of %.9g", value, expected);
}

static void shares_are_those_of_double_precision(void **state) {
    static plane_sample samples[MOST];
    static lobe_columns columns;
    (void)state;
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        const column_case *c = &cases[n];
        lobe_chance chances[MOMENT_MAXIMUM_BINS];
        plane_sums sums[MOMENT_MAXIMUM_BINS], expected[MOMENT_MAXIMUM_BINS] = {{0}};
        fill(c, samples, chances);
        passes_lobe_columns_fill(samples, c->samples, &columns);
        const double likelihood = passes_lobe_columns_share(&columns, chances, c->components, sums);
        const double wanted = share(c, samples, chances, expected);
        double weight = 0;
        assert_near(likelihood, wanted, fmax(1, fabs(wanted)));
        for (uint32_t k = 0; k < c->components; k++) {
            weight += sums[k].weight;
            assert_near(sums[k].weight, expected[k].weight, 1);
            assert_near(sums[k].variance, expected[k].variance, 1);
            for (int j = 0; j < 2; j++)
                assert_near(sums[k].place[j], expected[k].place[j], 1);
            for (int j = 0; j < 3; j++)
                assert_near(sums[k].moments[j], expected[k].moments[j], 1);
        }
        assert_near(weight, 1, 1);
    }
}

/// Sums are in lanes of a fixed order, so that they do not vary from run to run, nor with what was
/// in memory before.
static void sums_are_the_same_bits_every_time(void **state) {
    static plane_sample samples[MOST];
    static lobe_columns columns[2];
    const column_case *c = &cases[4];
    lobe_chance chances[MOMENT_MAXIMUM_BINS];
    plane_sums sums[2][MOMENT_MAXIMUM_BINS];
    double likelihoods[2];
    (void)state;
    fill(c, samples, chances);
    memset(&columns[1], 0x7f, sizeof columns[1]);
    for (int n = 0; n < 2; n++) {
        passes_lobe_columns_fill(samples, c->samples, &columns[n]);
        likelihoods[n] = passes_lobe_columns_share(&columns[n], chances, c->components, sums[n]);
    }
    assert_true(likelihoods[0] == likelihoods[1]);
    assert_memory_equal(sums[0], sums[1], c->components * sizeof sums[0][0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_are_those_of_double_precision),
        cmocka_unit_test(sums_are_the_same_bits_every_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
