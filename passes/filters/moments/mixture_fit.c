#include "passes/filters/moments/mixture_fit.h"

#include <math.h>

#include "passes/context/sample_pattern.h"
#include "passes/filters/moments/lobe_columns.h"

// More iterations do not change a picture.
enum { ROUNDS = 30 };

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

/// The exponential of a logarithm that is at most 0; most of them are 0 or far below.
static double share_of_largest(double logarithm) {
    if (logarithm == 0)
        return 1;
    return logarithm < -40 ? 0 : exp(logarithm);
}

double passes_mixture_share(const plane_mixture *m, const plane_sample *s,
                            double members[MOMENT_MAXIMUM_BINS]) {
    double most = -INFINITY, sum = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        members[i] = logarithm_of_chance(&m->components[i], m->points, s);
        most = fmax(most, members[i]);
    }
    for (uint32_t i = 0; i < m->count; i++)
        sum += members[i] = share_of_largest(members[i] - most);
    for (uint32_t i = 0; i < m->count; i++)
        members[i] /= sum;
    return most + log(sum);
}

/// The Gaussian of the sums, of which it has `weight` and whose places are from its mean; `points`
/// as for a fit.
static void move_component(const plane_sums *sums, double weight, double points,
                           mixture_component *c) {
    const double total = fmax(sums->weight, 1e-12), variance = sums->variance / total;
    const double step[2] = {sums->place[0] / total, sums->place[1] / total};
    c->weight = weight;
    c->covariance[0] = fmax(sums->moments[0] / total - step[0] * step[0], 0) + variance;
    c->covariance[1] = fmax(sums->moments[1] / total - step[1] * step[1], 0) + variance;
    c->covariance[2] = sums->moments[2] / total - step[0] * step[1];
    for (int i = 0; i < 2; i++)
        c->mean[i] += step[i];
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

/// From samples far from each other. `number`: of the first random number.
static void start_far_apart(const plane_sample *samples, uint32_t count, double spread,
                            uint64_t number, plane_mixture *m) {
    double nearest[SURVEY_TEXELS * LOBE_MATERIAL_MAXIMUM_LOBES];
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

/// What a start distinguishes: how broad lobes are, or how far from the middle.
static double key_of(const plane_sample *sample, const double middle[2], uint32_t start) {
    if (start == 0)
        return log(sample->variance);
    return hypot(sample->place[0] - middle[0], sample->place[1] - middle[1]);
}

static void find_middle(const plane_sample *samples, uint32_t count, double middle[2]) {
    plane_sums sums = {0};
    for (uint32_t i = 0; i < count; i++)
        passes_plane_sums_add(&sums, &samples[i], samples[i].weight);
    for (int i = 0; i < 2; i++)
        middle[i] = sums.place[i] / sums.weight;
}

/// From equal steps of the key; false if that is about the same everywhere.
static bool start_by_key(const plane_sample *samples, uint32_t count, uint32_t start,
                         plane_mixture *m) {
    plane_sums sums[MOMENT_MAXIMUM_BINS] = {{0}};
    double least = INFINITY, most = -INFINITY, total = 0, middle[2];
    find_middle(samples, count, middle);
    for (uint32_t i = 0; i < count; i++) {
        double key = key_of(&samples[i], middle, start);
        least = fmin(least, key);
        most = fmax(most, key);
        total += samples[i].weight;
    }
    if (!(most > least + (start == 0 ? 0.2 : 1e-3)))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        double part = (key_of(&samples[i], middle, start) - least) / (most - least);
        uint32_t k = (uint32_t)(0.999 * part * m->count);
        plane_sample moved = samples[i];
        for (int j = 0; j < 2; j++)
            moved.place[j] -= middle[j];
        passes_plane_sums_add(&sums[k], &moved, moved.weight);
    }
    for (uint32_t k = 0; k < m->count; k++) {
        m->components[k] = (mixture_component){.mean = {middle[0], middle[1]}};
        move_component(&sums[k], fmax(sums[k].weight / total, 1e-9), m->points, &m->components[k]);
    }
    return true;
}

// ---------------------------------------------------------------------------------------------
// Expectation and maximisation

static void improve(const lobe_columns *lobes, plane_mixture *m) {
    lobe_chance chances[MOMENT_MAXIMUM_BINS];
    plane_sums sums[MOMENT_MAXIMUM_BINS];
    for (uint32_t k = 0; k < m->count; k++) {
        const mixture_component *c = &m->components[k];
        chances[k] = (lobe_chance){.mean = {(float)c->mean[0], (float)c->mean[1]},
                                   .offset = (float)c->offset};
        for (int i = 0; i < 3; i++)
            chances[k].squares[i] = (float)(0.5 * m->points * c->inverse[i]);
    }
    m->likelihood = passes_lobe_columns_share(lobes, chances, m->count, sums);
    for (uint32_t k = 0; k < m->count; k++) {
        mixture_component *c = &m->components[k];
        if (sums[k].weight >= 1e-9) {
            c->mean[0] = (double)chances[k].mean[0];
            c->mean[1] = (double)chances[k].mean[1];
            move_component(&sums[k], sums[k].weight, m->points, c);
        } else {
            c->weight = 1e-9;
        }
    }
}

void passes_mixture_fit(const plane_sample *samples, uint32_t count, uint32_t bins, double points,
                        uint32_t start, plane_mixture *fitted) {
    const double spread = passes_plane_spread(samples, count);
    lobe_columns lobes;
    passes_lobe_columns_fill(samples, count, &lobes);
    *fitted = (plane_mixture){.count = bins, .points = points};
    if (start > 1 || !start_by_key(samples, count, start, fitted))
        start_far_apart(samples, count, spread, (uint64_t)start * MOMENT_MAXIMUM_BINS, fitted);
    double likelihood = -INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        improve(&lobes, fitted);
        if (!(fitted->likelihood > likelihood + 1e-4))
            break;
        likelihood = fitted->likelihood;
    }
}
