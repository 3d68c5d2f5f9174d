#include "passes/filters/moments/mixture_fit.h"

#include <math.h>

#include "passes/context/sample_pattern.h"

// More iterations do not change a picture.
enum { ROUNDS = 30, STARTS = 4 };

// ---------------------------------------------------------------------------------------------
// Components

static void invert(mixture_component *c, double points) {
    const double *m = c->covariance;
    c->determinant = fmax(m[0] * m[1] - m[2] * m[2], 1e-16);
    c->inverse[0] = m[1] / c->determinant;
    c->inverse[1] = m[0] / c->determinant;
    c->inverse[2] = -m[2] / c->determinant;
    c->offset = log(c->weight) - 0.5 * points * log(c->determinant);
}

/// Vasconcelos, Lippman, 1998, Learning Mixture Hierarchies, Eq. 8: the log likelihood of all
/// points of a sample under a component.
static double logarithm_of_chance(const mixture_component *c, double points,
                                  const plane_sample *s) {
    double x = s->place[0] - c->mean[0], y = s->place[1] - c->mean[1];
    double square = c->inverse[0] * x * x + c->inverse[1] * y * y + 2 * c->inverse[2] * x * y;
    double trace = s->variance * (c->inverse[0] + c->inverse[1]);
    return c->offset - 0.5 * points * (square + trace);
}

double passes_mixture_share(const plane_mixture *m, const plane_sample *s,
                            double members[MOMENT_MAXIMUM_BINS]) {
    double most = -INFINITY, sum = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        members[i] = logarithm_of_chance(&m->components[i], m->points, s);
        most = fmax(most, members[i]);
    }
    for (uint32_t i = 0; i < m->count; i++)
        sum += members[i] = exp(members[i] - most);
    for (uint32_t i = 0; i < m->count; i++)
        members[i] /= sum;
    return most + log(sum);
}

void passes_plane_sums_add(plane_sums *sums, const plane_sample *s, double weight) {
    double x = s->place[0], y = s->place[1];
    sums->weight += weight;
    sums->place[0] += weight * x;
    sums->place[1] += weight * y;
    sums->moments[0] += weight * x * x;
    sums->moments[1] += weight * y * y;
    sums->moments[2] += weight * x * y;
    sums->variance += weight * s->variance;
}

void passes_mixture_component_from(const plane_sums *sums, double weight, double points,
                                   mixture_component *c) {
    double total = fmax(sums->weight, 1e-12);
    c->weight = weight;
    for (int i = 0; i < 2; i++)
        c->mean[i] = sums->place[i] / total;
    double variance = sums->variance / total;
    c->covariance[0] = fmax(sums->moments[0] / total - c->mean[0] * c->mean[0], 0) + variance;
    c->covariance[1] = fmax(sums->moments[1] / total - c->mean[1] * c->mean[1], 0) + variance;
    c->covariance[2] = sums->moments[2] / total - c->mean[0] * c->mean[1];
    invert(c, points);
}

double passes_plane_spread(const plane_sample *samples, uint32_t count) {
    plane_sums sums = {0};
    for (uint32_t i = 0; i < count; i++)
        passes_plane_sums_add(&sums, &samples[i], samples[i].weight);
    double x = sums.place[0] / sums.weight, y = sums.place[1] / sums.weight;
    return fmax((sums.moments[0] + sums.moments[1]) / sums.weight - x * x - y * y, 0) / 2;
}

// ---------------------------------------------------------------------------------------------
// A start

/// How far apart two samples are, in widths and in factors of width.
static double distance(const plane_sample *a, const plane_sample *b, double spread) {
    double x = a->place[0] - b->place[0], y = a->place[1] - b->place[1];
    double ratio = log(a->variance / b->variance);
    return (x * x + y * y) / (spread + sqrt(a->variance * b->variance)) + ratio * ratio;
}

/// Chooses a sample with a probability that grows with its distance from all those chosen before
/// (Arthur, Vassilvitskii, 2007, k-means++). `nearest`: of each sample, the squared distance to
/// those before `last`.
static uint32_t choose_far(const plane_sample *samples, uint32_t count, uint32_t last,
                           double spread, double number, double *nearest) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        nearest[i] = fmin(nearest[i], distance(&samples[i], &samples[last], spread));
        sum += samples[i].weight * nearest[i];
    }
    double target = number * sum;
    uint32_t found = 0;
    while (found + 1 < count && (target -= samples[found].weight * nearest[found]) > 0)
        ++found;
    return found;
}

/// `index`: of the start; each has its own random numbers.
static void start(const plane_sample *samples, uint32_t count, double spread, uint32_t index,
                  plane_mixture *m) {
    double nearest[SURVEY_TEXELS * LOBE_MATERIAL_MAXIMUM_LOBES];
    uint64_t number = (uint64_t)index * MOMENT_MAXIMUM_BINS;
    for (uint32_t i = 0; i < count; i++)
        nearest[i] = INFINITY;
    uint32_t chosen = (uint32_t)(passes_hashed_number(number) * count);
    for (uint32_t k = 0; k < m->count; k++) {
        if (k > 0)
            chosen = choose_far(samples, count, chosen, spread, passes_hashed_number(number + k),
                                nearest);
        const plane_sample *s = &samples[chosen];
        mixture_component *c = &m->components[k];
        *c = (mixture_component){.weight = 1.0 / m->count, .mean = {s->place[0], s->place[1]}};
        c->covariance[0] = c->covariance[1] = s->variance + 0.1 * spread;
        invert(c, m->points);
    }
}

// ---------------------------------------------------------------------------------------------
// Expectation and maximisation

static void improve(const plane_sample *samples, uint32_t count, plane_mixture *m) {
    plane_sums sums[MOMENT_MAXIMUM_BINS] = {{0}};
    double total = 0;
    m->likelihood = 0;
    for (uint32_t i = 0; i < count; i++) {
        double members[MOMENT_MAXIMUM_BINS];
        m->likelihood += samples[i].weight * passes_mixture_share(m, &samples[i], members);
        total += samples[i].weight;
        for (uint32_t k = 0; k < m->count; k++)
            passes_plane_sums_add(&sums[k], &samples[i], samples[i].weight * members[k]);
    }
    m->likelihood /= total;
    for (uint32_t k = 0; k < m->count; k++) {
        mixture_component *c = &m->components[k];
        if (sums[k].weight >= 1e-9 * total)
            passes_mixture_component_from(&sums[k], sums[k].weight / total, m->points, c);
        else
            c->weight = 1e-9;
    }
}

void passes_mixture_fit(const plane_sample *samples, uint32_t count, uint32_t bins, double points,
                        plane_mixture *fitted) {
    const double spread = passes_plane_spread(samples, count);
    for (uint32_t i = 0; i < (bins > 1 ? STARTS : 1); i++) {
        plane_mixture trial = {.count = bins, .points = points};
        start(samples, count, spread, i, &trial);
        for (int round = 0; round < (bins > 1 ? ROUNDS : 1); round++)
            improve(samples, count, &trial);
        if (i == 0 || trial.likelihood > fitted->likelihood)
            *fitted = trial;
    }
}
