#include "tests/reference/microfacet/facing_normals.h"

#include <math.h>

#include "tests/reference/lobe/lambert_plane.h"
#include "tests/reference/vector.h"

/// Change of a normal with its place, by differences.
static void steps_at(const double place[2], double steps[2][3]) {
    static const double step = 1e-5;
    for (int i = 0; i < 2; i++) {
        double ends[2][3];
        for (int end = 0; end < 2; end++) {
            double moved[2] = {place[0], place[1]};
            moved[i] += end ? step : -step;
            reference_direction_from_plane(moved, ends[end]);
        }
        for (int j = 0; j < 3; j++)
            steps[i][j] = (ends[1][j] - ends[0][j]) / (2 * step);
    }
}

reference_normals reference_normals_of(const double places[2], const double seconds[3],
                                       double weight) {
    reference_normals normals = {.place = {places[0] / weight, places[1] / weight}};
    for (int i = 0; i < 3; i++)
        normals.covariance[i] = seconds[i] / weight - normals.place[i == 1] * normals.place[i != 0];
    reference_direction_from_plane(normals.place, normals.mean);
    normals.mean[2] = 1 - 0.5 * (seconds[0] + seconds[1]) / weight;
    return normals;
}

/// A normal number above 0 by its mean in standard deviations: share, shift and what is taken from
/// the variance. The distribution function is Page's, as in the shader, the density its derivative.
static void cut_off(double mean, double *share, double *shift, double *narrower) {
    double x = fmin(fmax(mean, -3), 10), scale = 2 * sqrt(2 / M_PI);
    *share = 1 / (1 + exp(-scale * (x + 0.044715 * x * x * x)));
    *shift = scale * (1 + 3 * 0.044715 * x * x) * (1 - *share);
    if (mean <= -3)
        *share = 0;
    *narrower = fmin(fmax(*shift * (*shift + x), 0), 0.95);
}

/// Covariance of <n, direction> with the places; returns its standard deviation.
static double covariance_with(const reference_normals *normals, const double direction[3],
                              double steps[2][3], double with[2]) {
    const double *c = normals->covariance;
    double gradient[2];
    steps_at(normals->place, steps);
    for (int i = 0; i < 2; i++)
        gradient[i] = reference_dot(steps[i], direction);
    with[0] = c[0] * gradient[0] + c[2] * gradient[1];
    with[1] = c[2] * gradient[0] + c[1] * gradient[1];
    return sqrt(fmax(with[0] * gradient[0] + with[1] * gradient[1], 1e-10));
}

double reference_face(reference_normals *normals, const double direction[3]) {
    double steps[2][3], with[2], share, shift, narrower;
    double deviation = covariance_with(normals, direction, steps, with);
    cut_off(reference_dot(normals->mean, direction) / deviation, &share, &shift, &narrower);
    for (int i = 0; i < 3; i++) {
        normals->mean[i] += shift / deviation * (steps[0][i] * with[0] + steps[1][i] * with[1]);
        normals->covariance[i] -= narrower / (deviation * deviation) * with[i == 1] * with[i != 0];
    }
    return share;
}

double reference_mean_facing_cosine(const reference_normals *normals, const double direction[3]) {
    double steps[2][3], with[2], share, shift, narrower;
    double deviation = covariance_with(normals, direction, steps, with);
    double mean = reference_dot(normals->mean, direction);
    cut_off(mean / deviation, &share, &shift, &narrower);
    return share * fmax(mean + deviation * shift, 0);
}
