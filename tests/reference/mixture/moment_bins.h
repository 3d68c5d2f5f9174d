#ifndef TESTS_REFERENCE_MIXTURE_MOMENT_BINS_H
#define TESTS_REFERENCE_MIXTURE_MOMENT_BINS_H

#include <stdbool.h>

#include "shaders/interface/moment_bins.h"
#include "tests/reference/mixture/layers.h"

/// Moments of lobes by bins in double precision; see shaders/filters/moments/binning.comp and
/// shaders/lib/lobe/bin_membership.glsl.

/// How lobes are assigned to bins, and the divisors of their moments.
typedef struct reference_moment_bins {
    uint32_t kind; ///< PARTITION_...
    uint32_t bins;
    bool colour;      ///< bins have colours
    bool mirrored;    ///< in these, lobes count by what they mirror
    bool many_points; ///< of each texel
    double mass_scale, colour_scale;
    struct moment_binning_constants constants;
} reference_moment_bins;

/// A base lobe in the Lambert plane.
typedef struct reference_plane_lobe {
    double place[2], variance, mass;
    double colour[4]; ///< specular; of microfacets that of metal, and what is not metal
    double mirrored;  ///< how much it counts in a bin with colours, over its mass
} reference_plane_lobe;

/// Layers of a map.
uint32_t reference_moment_layers(const reference_moment_bins *partition);

/// The logarithm, up to a constant, of the probability that all points of a lobe belong to a
/// component.
double reference_bin_likelihood(const struct moment_bin *bin, const double place[2],
                                double variance);
/// Two hats across the middle, at `distance` widths from it; and the cap between four of them.
double reference_hat(double widths);
double reference_cap(const double widths[2]);

/// The share of a lobe that each bin gets, [0, 1]; the shares add up to one.
void reference_bin_members(const reference_moment_bins *partition, const reference_plane_lobe *lobe,
                           double members[MOMENT_MAXIMUM_BINS]);
void reference_add_plane_lobe(const reference_moment_bins *partition,
                              const reference_plane_lobe *lobe, const reference_layers *layers,
                              uint32_t x, uint32_t y);

#endif
