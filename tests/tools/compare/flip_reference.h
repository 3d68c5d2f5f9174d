#ifndef TESTS_TOOLS_COMPARE_FLIP_REFERENCE_H
#define TESTS_TOOLS_COMPARE_FLIP_REFERENCE_H

/// FLIP for low dynamic range, written down from the paper's formulas without regard to speed:
/// two-dimensional kernels, double precision. `test` and `reference` are linear RGB [0, 1], three
/// doubles per texel; `errors` one.
void flip_reference(const double *test, const double *reference, int width, int height,
                    double pixels_per_degree, double *errors);

#endif
