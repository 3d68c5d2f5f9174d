#include "passes/filters/moments/footprints/facing.h"

#include <math.h>

/// 70 degrees from upright, as low as relief is usually looked at.
static const double viewers[FACING_VIEWERS][3] = {
    {0.9396926207859084, 0, 0.3420201433256687},
    {0.6644630243886747, 0.6644630243886747, 0.3420201433256687},
    {0, 0.9396926207859084, 0.3420201433256687},
    {-0.6644630243886747, 0.6644630243886747, 0.3420201433256687},
    {-0.9396926207859084, 0, 0.3420201433256687},
    {-0.6644630243886747, -0.6644630243886747, 0.3420201433256687},
    {0, -0.9396926207859084, 0.3420201433256687},
    {0.6644630243886747, -0.6644630243886747, 0.3420201433256687},
};

/// What the plane's coordinates count in a direction's first two (lib/lobe/lambert_plane.glsl).
static double scale_at(const double place[2]) {
    return sqrt(fmax(1 - 0.25 * (place[0] * place[0] + place[1] * place[1]), 0));
}

/// Of directions whose third coordinate is 1 - square / 2 on the mean.
static double cosine_at(const double place[2], double square, const double viewer[3]) {
    return scale_at(place) * (place[0] * viewer[0] + place[1] * viewer[1]) +
           (1 - 0.5 * square) * viewer[2];
}

void passes_facing_add_sample(facing_light *light, const plane_sample *sample, double weight) {
    const double *place = sample->place, square = place[0] * place[0] + place[1] * place[1];
    for (uint32_t i = 0; i < FACING_VIEWERS; i++)
        light->seen[i] += weight * fmax(cosine_at(place, square, viewers[i]), 0);
}

/// Of a normal number.
static double mean_above_zero(double mean, double deviation) {
    if (!(deviation > 1e-6))
        return fmax(mean, 0);
    const double x = mean / deviation;
    return 0.5 * mean * erfc(-x * M_SQRT1_2) + deviation * exp(-0.5 * x * x) / sqrt(2 * M_PI);
}

void passes_facing_add_bin(facing_light *light, const plane_sums *sums, double weight) {
    const double place[2] = {sums->place[0] / sums->weight, sums->place[1] / sums->weight};
    const double square = (sums->moments[0] + sums->moments[1]) / sums->weight;
    const double scale = scale_at(place);
    double covariance[3];
    passes_plane_sums_covariance(sums, covariance);
    for (uint32_t i = 0; i < FACING_VIEWERS; i++) {
        const double *viewer = viewers[i];
        const double x = scale * viewer[0] - place[0] * viewer[2];
        const double y = scale * viewer[1] - place[1] * viewer[2];
        const double variance =
            x * x * covariance[0] + y * y * covariance[1] + 2 * x * y * covariance[2];
        light->seen[i] +=
            weight * mean_above_zero(cosine_at(place, square, viewer), sqrt(fmax(variance, 0)));
    }
}

double passes_facing_error(const facing_light *light, const facing_light *truth) {
    double error = 0, all = 0;
    for (uint32_t i = 0; i < FACING_VIEWERS; i++) {
        const double difference = light->seen[i] - truth->seen[i];
        error += difference * difference;
        all += truth->seen[i] * truth->seen[i];
    }
    return error / fmax(all, 1e-30);
}
