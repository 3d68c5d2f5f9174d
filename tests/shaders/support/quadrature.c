#include "tests/shaders/support/quadrature.h"

#include <math.h>

#include "tests/shaders/support/samples.h"

// The Legendre polynomial P_n and its derivative, by their three-term recurrence.
static void legendre(int n, double x, double *value, double *derivative) {
    double before = 1, now = x;
    for (int k = 2; k <= n; k++) {
        double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
    }
    *value = now;
    *derivative = n * (x * now - before) / (x * x - 1);
}

// Golub, Welsch, 1969, Calculation of Gauss Quadrature Rules, by Newton's method on the roots.
void gauss_legendre(double low, double high, quadrature_node nodes[QUADRATURE_ORDER]) {
    for (int i = 0; i < QUADRATURE_ORDER; i++) {
        double x = cos(M_PI * (i + 0.75) / (QUADRATURE_ORDER + 0.5));
        double value, derivative;
        for (int step = 0; step < 8; step++) {
            legendre(QUADRATURE_ORDER, x, &value, &derivative);
            x -= value / derivative;
        }
        legendre(QUADRATURE_ORDER, x, &value, &derivative);
        nodes[i].x = 0.5 * (low + high) + 0.5 * (high - low) * x;
        nodes[i].weight = (high - low) / ((1 - x * x) * derivative * derivative);
    }
}

void geometric_quadrature(double first, double high, size_t panels, quadrature_node *nodes) {
    double low = 0;
    for (size_t i = 0; i < panels; i++) {
        double end = panels > 1 ? geometric(first, high, i, panels) : high;
        gauss_legendre(low, end, nodes + i * QUADRATURE_ORDER);
        low = end;
    }
}
