#include "passes/environment/broad_reflection.h"

#include <math.h>

#include "passes/environment/reflection_table.h"
#include "shaders/interface/environment/broad_reflection.h"
#include "shaders/interface/environment/environment_light.h"
#include "shaders/interface/environment/reflected_rings.h"
#include "shaders/interface/specialisation.h"

// ---------------------------------------------------------------------------------------------
// Least squares over spherical harmonics

enum { NODES = 16, ROWS = BROAD_DEGREE + 1 };

/// On [0, 1].
typedef struct quadrature {
    double nodes[NODES], weights[NODES];
} quadrature;

/// Gauss and Legendre's, by Newton's method.
static void make_quadrature(quadrature *rule) {
    for (int i = 0; i < NODES; i++) {
        double x = cos(M_PI * (i + 0.75) / (NODES + 0.5)), slope = 1;
        for (int step = 0; step < 8; step++) {
            double before = 1, current = x;
            for (int n = 2; n <= NODES; n++) {
                double next = ((2 * n - 1) * x * current - (n - 1) * before) / n;
                before = current;
                current = next;
            }
            slope = NODES * (x * current - before) / (x * x - 1);
            x -= current / slope;
        }
        rule->nodes[i] = 0.5 + 0.5 * x;
        rule->weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

/// The weight of a degree: environments have less and less light in higher ones. The mean and the
/// mean direction matter most.
static double weight_of_degree(int degree) {
    return degree == 0 ? 100 : degree == 1 ? 10 : 1 / (1 + degree * degree / 9.0);
}

/// The factor of the harmonic's polynomial in the height, whose leading function of its order is 1.
static double scale_of_harmonic(int order, int degree) {
    double square = (2 * degree + 1) / (4 * M_PI) * (order > 0 ? 2 : 1);
    for (int i = degree - order + 1; i <= degree + order; i++)
        square /= i;
    double leading = 1;
    for (int i = 1; i <= order; i++)
        leading *= 2 * i - 1;
    return leading * sqrt(square * weight_of_degree(degree));
}

/// rows[l - order]: the weighted harmonics of z times z^power times (sin theta)^order cos(order
/// azimuth) over the hemisphere.
static void harmonics_of_function(const quadrature *rule, int order, int power, double rows[ROWS]) {
    double scale[ROWS] = {0};
    for (int k = 0; k < ROWS; k++)
        rows[k] = 0;
    for (int l = order; l <= BROAD_DEGREE; l++)
        scale[l - order] = scale_of_harmonic(order, l);
    for (int i = 0; i < NODES; i++) {
        const double z = rule->nodes[i], square = 1 - z * z;
        double value = rule->weights[i] * pow(z, power + 1) * pow(square, order) *
                       (order > 0 ? M_PI : 2 * M_PI);
        double before = 0, current = 1;
        for (int l = order; l <= BROAD_DEGREE; l++) {
            rows[l - order] += value * current * scale[l - order];
            double next = (z * (2 * l + 1) * current - (l + order) * before) / (l + 1 - order);
            before = current;
            current = next;
        }
    }
}

/// Solves the symmetric system in place, by Gauss's elimination: `count` unknowns, each with `ROWS`
/// right sides.
static void solve(int count, double matrix[BROAD_ORDERS][BROAD_ORDERS],
                  double right[BROAD_ORDERS][ROWS]) {
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            if (j == i)
                continue;
            const double factor = matrix[j][i] / matrix[i][i];
            for (int k = 0; k < count; k++)
                matrix[j][k] -= factor * matrix[i][k];
            for (int k = 0; k < ROWS; k++)
                right[j][k] -= factor * right[i][k];
        }
    }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < ROWS; k++)
            right[i][k] /= matrix[i][i];
}

/// What the harmonics of an order contribute to the coefficients of its functions.
static void fit_order(int count, double rows[BROAD_ORDERS][ROWS],
                      double right[BROAD_ORDERS][ROWS]) {
    double products[BROAD_ORDERS][BROAD_ORDERS];
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < ROWS; k++)
            right[i][k] = rows[i][k];
        for (int j = 0; j < count; j++) {
            products[i][j] = 0;
            for (int k = 0; k < ROWS; k++)
                products[i][j] += rows[i][k] * rows[j][k];
        }
    }
    solve(count, products, right);
}

static struct broad_harmonics known_harmonics(void) {
    struct broad_harmonics known = {0};
    int harmonic = 0, function = 0;
    quadrature rule;
    make_quadrature(&rule);
    for (int order = 0; order < BROAD_ORDERS; order++) {
        for (int degree = order; degree <= BROAD_DEGREE; degree++)
            known.scale[harmonic++] = (float)scale_of_harmonic(order, degree);
        const int count = BROAD_ORDERS - order;
        double rows[BROAD_ORDERS][ROWS], fit[BROAD_ORDERS][ROWS];
        for (int i = 0; i < count; i++)
            harmonics_of_function(&rule, order, i, rows[i]);
        fit_order(count, rows, fit);
        for (int i = 0; i < count; i++, function++) {
            for (int k = 0; k < ROWS; k++) {
                known.coefficient[12 * function + k] = (float)fit[i][k];
                known.harmonic[12 * function + k] = (float)rows[i][k];
            }
        }
    }
    return known;
}

// ---------------------------------------------------------------------------------------------
// The pass

lobe_resource passes_broad_reflection(lobe_graph *graph, lobe_distribution distribution,
                                      lobe_distribution masking, uint32_t probes) {
    lobe_resource table = passes_reflection_table(graph, "broad reflection", distribution, masking,
                                                  BROAD_REFLECTION_SIZE, BROAD_REFLECTION_LAYERS);
    const struct broad_harmonics known = known_harmonics();
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "broad_reflection");
    lobe_pass_read(pass, &(lobe_binding){.name = "harmonics_block",
                                         .resource = lobe_graph_upload(graph, "broad harmonics",
                                                                       &known, sizeof known)});
    table = lobe_pass_write(pass, &(lobe_binding){.name = "broad_reflection", .resource = table});
    const lobe_specialisation specialisation[] = {
        {SPECIALISE_DISTRIBUTION, (uint32_t)distribution},
        {SPECIALISE_MASKING, (uint32_t)masking},
        {SPECIALISE_ENVIRONMENT_PROBES, probes},
    };
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/broad_reflection.comp",
                                              .threads = {REFLECTED_RINGS * BROAD_REFLECTION_SIZE,
                                                          BROAD_REFLECTION_SIZE},
                                              .specialisation = specialisation,
                                              .specialisation_count = 3});
    return table;
}
