// The table of directional albedo against integrals in double precision.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/environment/directional_albedo.h"
#include "shaders/interface/environment/directional_albedo.h"
#include "tests/reference/microfacet/directional_albedo.h"

enum { SIZE = DIRECTIONAL_ALBEDO_SIZE, DISTRIBUTIONS = LOBE_DISTRIBUTION_VMF + 1 };

typedef struct albedo_table {
    float texels[SIZE][SIZE][4];
} albedo_table;

/// The tables of all distributions in one frame.
static void tabulate(fixture *f, albedo_table tables[DISTRIBUTIONS]) {
    lobe_resource resources[DISTRIBUTIONS];
    lobe_graph_begin(f->graph);
    for (int i = 0; i < DISTRIBUTIONS; i++) {
        resources[i] =
            passes_directional_albedo(f->graph, (lobe_distribution)i, (lobe_distribution)i);
        lobe_graph_read_back(f->graph, resources[i], (lobe_range){0});
    }
    if (lobe_graph_execute(f->graph) != LOBE_OK)
        fail_msg("%s", f->error);
    for (int i = 0; i < DISTRIBUTIONS; i++) {
        size_t size;
        const void *data = lobe_graph_data(f->graph, resources[i], &size);
        assert_int_equal(size, sizeof *tables);
        memcpy(&tables[i], data, size);
    }
}

static albedo_table tables[DISTRIBUTIONS];

static int set_up(void **state) {
    int result = fixture_create_validated(state);
    if (result == 0)
        tabulate(*state, tables);
    return result;
}

static double cosine_of(int column) {
    return fmax(pow((double)column / (SIZE - 1), 2), 1e-6);
}

static double roughness_of(int row) {
    return (double)row / (SIZE - 1);
}

static void check_close(const char *what, int distribution, double cosine, double roughness,
                        double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance))
        fail_msg("%s of distribution %d at cosine %g and roughness %g: %.6g instead of %.6g", what,
                 distribution, cosine, roughness, found, expected);
}

/// From roughest to smoothest, and from perpendicular to nearly grazing.
static void texels_are_integrals(void **state) {
    (void)state;
    static const int columns[] = {2, 9, 13, 20, 31, 45, 63}, rows[] = {2, 4, 7, 13, 20, 32, 48, 63};
    for (int d = 0; d < DISTRIBUTIONS; d++) {
        for (size_t i = 0; i < 7 * 8; i++) {
            int column = columns[i % 7], row = rows[i / 7];
            double cosine = cosine_of(column), roughness = roughness_of(row), expected[2];
            reference_specular_parts((lobe_distribution)d, cosine, roughness, expected);
            const float *found = tables[d].texels[row][column];
            for (int j = 0; j < 2; j++)
                check_close(j ? "part of F_90" : "part of F_0", d, cosine, roughness, found[j],
                            expected[j], 3e-4);
        }
    }
}

static void lambert_loses_what_fresnel_reflects(void **state) {
    (void)state;
    for (int column = 0; column < SIZE; column += 9) {
        double cosine = cosine_of(column), expected = reference_diffuse_part(cosine);
        for (int d = 0; d < DISTRIBUTIONS; d++)
            for (int row = 0; row < SIZE; row += 21)
                check_close("part that Lambert loses", d, cosine, roughness_of(row),
                            tables[d].texels[row][column][2], expected, 3e-5);
    }
    // Right above: integral of (1 - sqrt((1 + c)/2))^5 2 c dc, with c = 2 y^2 - 1.
    double exact = 0;
    for (int i = 0; i < 1000; i++) {
        double y = sqrt(0.5) + (1 - sqrt(0.5)) * (i + 0.5) / 1000;
        exact += pow(1 - y, 5) * 2 * (2 * y * y - 1) * 4 * y * (1 - sqrt(0.5)) / 1000;
    }
    check_close("part that Lambert loses", 0, 1, 1, tables[0].texels[0][SIZE - 1][2], exact, 1e-7);
}

/// Smooth surfaces lose nothing and have Schlick's reflectance, except near the horizon.
static void smooth_surfaces_are_mirrors(void **state) {
    (void)state;
    for (int d = 0; d < DISTRIBUTIONS; d++) {
        for (int column = 16; column < SIZE; column++) {
            double cosine = cosine_of(column), fifth = pow(1 - cosine, 5);
            const float *found = tables[d].texels[0][column];
            check_close("albedo", d, cosine, 0, (double)found[0] + (double)found[1], 1, 5e-4);
            check_close("part of F_90", d, cosine, 0, found[1], fifth, 1e-3);
        }
    }
}

/// GGX and Beckmann reflect no more than arrives: the masking function is theirs.
static void nothing_is_gained(void **state) {
    (void)state;
    for (int d = LOBE_DISTRIBUTION_GGX; d <= LOBE_DISTRIBUTION_BECKMANN; d++) {
        for (int i = 0; i < SIZE * SIZE; i++) {
            const float *found = tables[d].texels[i / SIZE][i % SIZE];
            double albedo = (double)found[0] + (double)found[1];
            assert_true(found[0] >= 0 && found[1] >= 0 && albedo > 0.2 && albedo < 1 + 3e-4);
        }
    }
}

/// Mean under uniform light: integral of 2 cos E(cos) d cos, by the reference's own integrals.
static void rows_have_their_mean(void **state) {
    (void)state;
    static const int rows[] = {0, 20, 63};
    for (int d = 0; d < DISTRIBUTIONS; d++) {
        for (int i = 0; i < 3; i++) {
            double roughness = roughness_of(rows[i]), sum = 0, whole = 0, parts[2];
            for (int j = 0; j < 16; j++) {
                double cosine = (j + 0.5) / 16;
                reference_specular_parts((lobe_distribution)d, cosine, roughness, parts);
                sum += cosine * (parts[0] + parts[1]);
                whole += cosine;
            }
            for (int column = 0; column < SIZE; column += 21)
                check_close("mean", d, 1, roughness, tables[d].texels[rows[i]][column][3],
                            sum / whole, 1e-3);
        }
    }
}

/// What the sampler returns: linear interpolation between texels.
static double interpolate(const albedo_table *table, double cosine, double roughness, int channel) {
    double x = sqrt(cosine) * (SIZE - 1), y = roughness * (SIZE - 1), sum = 0;
    int column = (int)fmin(x, SIZE - 2), row = (int)fmin(y, SIZE - 2);
    for (int i = 0; i < 4; i++) {
        double weight = (i % 2 ? x - column : 1 - (x - column)) * (i / 2 ? y - row : 1 - (y - row));
        sum += weight * (double)table->texels[row + i / 2][column + i % 2][channel];
    }
    return sum;
}

/// Between texels too, a white surface with multiple scattering is white.
static void white_stays_white(void **state) {
    (void)state;
    for (int d = 0; d < DISTRIBUTIONS; d++) {
        double squares = 0, worst = 0;
        enum { PLACES = 64 };
        for (int i = 0; i < PLACES; i++) {
            // The golden ratio spreads them evenly, and not on texel centres.
            double cosine = 0.02 * pow(50, fmod(0.5 + 0.618033988749895 * i, 1));
            double roughness = 0.05 + 0.95 * (i + 0.5) / PLACES, parts[2], found[2];
            reference_specular_parts((lobe_distribution)d, cosine, roughness, parts);
            for (int j = 0; j < 2; j++) {
                found[j] = interpolate(&tables[d], cosine, roughness, j);
                double error = fabs(found[j] - parts[j]);
                worst = fmax(worst, error);
                squares += error * error;
                check_close("interpolated part", d, cosine, roughness, found[j], parts[j], 2.2e-3);
            }
            double table = found[0] + found[1], once = parts[0] + parts[1];
            check_close("white furnace", d, cosine, roughness, once * (1 + (1 - table) / table), 1,
                        2.5e-3);
        }
        print_message("# distribution %d between texels: %.2g, root mean square %.2g\n", d, worst,
                      sqrt(squares / (2 * PLACES)));
        assert_true(squares <= 2 * PLACES * 3e-4 * 3e-4);
    }
}

static void tables_are_made_once(void **state) {
    fixture *f = *state;
    static albedo_table again[DISTRIBUTIONS];
    tabulate(f, again);
    assert_int_equal(count_passes(f->graph, NULL, LOBE_PASS_RUN), 0);
    assert_memory_equal(again, tables, sizeof again);
    lobe_graph_invalidate(f->graph);
    tabulate(f, again);
    assert_int_equal(count_passes(f->graph, "directional_albedo", LOBE_PASS_RUN), 0);
    assert_memory_equal(again, tables, sizeof again);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_are_integrals),
        cmocka_unit_test(lambert_loses_what_fresnel_reflects),
        cmocka_unit_test(smooth_surfaces_are_mirrors),
        cmocka_unit_test(nothing_is_gained),
        cmocka_unit_test(rows_have_their_mean),
        cmocka_unit_test(white_stays_white),
        cmocka_unit_test(tables_are_made_once),
        cmocka_unit_test(validation_is_silent),
    };
    return cmocka_run_group_tests(tests, set_up, fixture_destroy);
}
