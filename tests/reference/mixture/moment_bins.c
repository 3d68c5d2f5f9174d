#include "tests/reference/mixture/moment_bins.h"

#include <math.h>

static double clamp(double x) {
    return fmin(fmax(x, 0), 1);
}

uint32_t reference_moment_layers(const reference_moment_bins *partition) {
    return partition->colour ? 3 * partition->bins + 1 : 2 * partition->bins;
}

double reference_bin_likelihood(const struct moment_bin *bin, const double place[2],
                                double variance) {
    double x = place[0] - (double)bin->centre[0], y = place[1] - (double)bin->centre[1];
    double square = (double)bin->shape[0] * x * x + (double)bin->shape[1] * y * y +
                    2 * (double)bin->shape[2] * x * y;
    return (double)bin->centre[2] - square - (double)bin->centre[3] * variance;
}

double reference_hat(double widths) {
    return clamp(0.5 + widths);
}

double reference_cap(const double widths[2]) {
    return clamp(1 - widths[0] * widths[0] - widths[1] * widths[1]);
}

static void share_fitted(const reference_moment_bins *partition, const reference_plane_lobe *lobe,
                         double members[MOMENT_MAXIMUM_BINS]) {
    double chances[MOMENT_MAXIMUM_BINS];
    for (uint32_t i = 0; i < partition->bins; i++)
        chances[i] =
            reference_bin_likelihood(&partition->constants.bins[i], lobe->place, lobe->variance);
    for (uint32_t i = 0; i < partition->bins; i++) {
        double sum = 0;
        for (uint32_t j = 0; j < partition->bins; j++)
            sum += exp(chances[j] - chances[i]);
        members[i] = 1 / sum;
    }
}

static void share_hats(const reference_moment_bins *partition, const reference_plane_lobe *lobe,
                       double members[MOMENT_MAXIMUM_BINS]) {
    const float *hats = partition->constants.hats;
    if (lobe->variance >= (double)hats[3]) {
        members[0] = 1;
        return;
    }
    double widths[2];
    for (int i = 0; i < 2; i++)
        widths[i] = (lobe->place[i] - (double)hats[i]) * (double)hats[2];
    if (partition->kind == PARTITION_CAP)
        members[5] = reference_cap(widths);
    for (int i = 0; i < 4; i++)
        members[1 + i] = (1 - members[5]) * reference_hat(i % 2 ? -widths[0] : widths[0]) *
                         reference_hat(i / 2 ? -widths[1] : widths[1]);
}

void reference_bin_members(const reference_moment_bins *partition, const reference_plane_lobe *lobe,
                           double members[MOMENT_MAXIMUM_BINS]) {
    for (int i = 0; i < MOMENT_MAXIMUM_BINS; i++)
        members[i] = 0;
    if (partition->kind == PARTITION_FITTED)
        share_fitted(partition, lobe, members);
    else
        share_hats(partition, lobe, members);
}

void reference_add_plane_lobe(const reference_moment_bins *partition,
                              const reference_plane_lobe *lobe, const reference_layers *layers,
                              uint32_t x, uint32_t y) {
    double members[MOMENT_MAXIMUM_BINS];
    reference_bin_members(partition, lobe, members);
    for (uint32_t i = 0; i < partition->bins; i++) {
        const struct moment_bin *bin = &partition->constants.bins[i];
        double mass = members[i] * lobe->mass / partition->mass_scale, p[2];
        for (int j = 0; j < 2; j++)
            p[j] = (lobe->place[j] - (double)bin->range[j]) / (double)bin->range[2];
        const double place[4] = {1, p[0], p[1], 1 / sqrt(lobe->variance) / (double)bin->range[3]};
        const double spread[4] = {p[0] * p[0], p[1] * p[1], p[0] * p[1],
                                  lobe->variance / (double)bin->shape[3]};
        uint32_t layer = (partition->colour ? 3 : 2) * i;
        const double counts = mass * (partition->mirrored ? lobe->mirrored : 1);
        for (int j = 0; j < 4; j++) {
            reference_texel(layers, x, y, layer)[j] += (j == 0 ? mass : counts) * place[j];
            reference_texel(layers, x, y, layer + 1)[j] += counts * spread[j];
            if (partition->colour)
                reference_texel(layers, x, y, layer + 2)[j] +=
                    mass * lobe->colour[j] / (j < 3 ? partition->colour_scale : 1);
        }
    }
}
