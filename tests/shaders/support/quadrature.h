#ifndef TESTS_SHADERS_SUPPORT_QUADRATURE_H
#define TESTS_SHADERS_SUPPORT_QUADRATURE_H

#include <stddef.h>

/// Integrals of functions that are evaluated on the device: nodes and weights, all at once.

typedef struct quadrature_node {
    double x, weight;
} quadrature_node;

enum { QUADRATURE_ORDER = 12 };

/// Gauss-Legendre on [low, high]: exact for polynomials up to degree 23. Writes QUADRATURE_ORDER
/// nodes.
void gauss_legendre(double low, double high, quadrature_node nodes[QUADRATURE_ORDER]);

/// Gauss-Legendre on each of `panels` intervals of [0, high]: the first ends at `first`, each
/// later end is the same multiple of the one before. For functions that are sharp at zero. Writes
/// panels * QUADRATURE_ORDER nodes.
void geometric_quadrature(double first, double high, size_t panels, quadrature_node *nodes);

#endif
