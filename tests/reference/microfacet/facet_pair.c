#include "tests/reference/microfacet/facet_pair.h"

#include <math.h>

#include "tests/reference/vector.h"

static double squared_length(const double slope[2]) {
    return slope[0] * slope[0] + slope[1] * slope[1];
}

void reference_facet_normals(const double slope[2], double normals[2][3]) {
    const double length = sqrt(squared_length(slope)), area = sqrt(1 + length * length);
    for (int i = 0; i < 2; i++) {
        normals[MAPPED_FACET][i] = -slope[i] / area;
        normals[UPRIGHT_FACET][i] = slope[i] / length;
    }
    normals[MAPPED_FACET][2] = 1 / area;
    normals[UPRIGHT_FACET][2] = 0;
}

/// Areas times cosines.
static void projected_areas(const double slope[2], const double direction[3], double areas[2]) {
    const double across = slope[0] * direction[0] + slope[1] * direction[1];
    areas[MAPPED_FACET] = fmax(direction[2] - across, 0);
    areas[UPRIGHT_FACET] = fmax(across, 0);
}

void reference_facet_shares(const double slope[2], const double direction[3], double shares[2]) {
    double areas[2];
    projected_areas(slope, direction, areas);
    for (int i = 0; i < 2; i++)
        shares[i] = areas[i] / (areas[MAPPED_FACET] + areas[UPRIGHT_FACET]);
}

double reference_facet_masking(const double slope[2], const double direction[3]) {
    double areas[2];
    projected_areas(slope, direction, areas);
    return direction[2] <= 0 ? 0
                             : fmin(direction[2] / (areas[MAPPED_FACET] + areas[UPRIGHT_FACET]), 1);
}

double reference_facet_exchange(const double slope[2]) {
    const double upright = sqrt(squared_length(slope)), mapped = sqrt(1 + upright * upright);
    return (mapped + upright - 1) / (2 * mapped);
}

double reference_facet_gain(const double slope[2], double albedo, double returned) {
    const double upright = sqrt(squared_length(slope)), mapped = sqrt(1 + upright * upright);
    const double exchange = reference_facet_exchange(slope);
    const double back = mapped * (albedo * exchange - (1 - exchange) * returned);
    return albedo / (upright - albedo * back);
}

/// Q.
static double met_by_upright_facet(const double slope[2], double albedo,
                                   const double direction[3]) {
    double shares[2];
    reference_facet_shares(slope, direction, shares);
    return shares[UPRIGHT_FACET] + shares[MAPPED_FACET] * albedo * reference_facet_exchange(slope);
}

double reference_lambert_facet_pair(const double slope[2], double albedo, const double outgoing[3],
                                    const double incoming[3]) {
    double normals[2][3], shares[2];
    reference_facet_normals(slope, normals);
    reference_facet_shares(slope, outgoing, shares);
    const double returned = albedo * reference_facet_exchange(slope);
    const double first = shares[MAPPED_FACET] * albedo *
                         fmax(reference_dot(normals[MAPPED_FACET], incoming), 0) *
                         reference_facet_masking(slope, incoming);
    return (first + met_by_upright_facet(slope, albedo, outgoing) *
                        met_by_upright_facet(slope, albedo, incoming) *
                        reference_facet_gain(slope, albedo, returned) * incoming[2]) /
           M_PI;
}
