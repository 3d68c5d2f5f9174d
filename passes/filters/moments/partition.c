#include "passes/filters/moments/partition.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/maps/material_patch.h"
#include "passes/upload/material_maps.h"

// More samples or iterations do not change a picture.
enum { SAMPLES = 512, ROUNDS = 30, STARTS = 4 };

// A lobe counts as this many points drawn from it: the more points, the harder the borders between
// bins. Hard borders are better for lobes that differ in width, soft ones for lobes that differ in
// direction, because they leave no valleys between bins. All numbers are tried for each material,
// and the best is used. Relative L2 over patches with 1.5, 3 and 10 points: bumps, five bins, 0.21,
// 0.23, 0.24; tablecloth, four bins, 0.07, 0.09, 0.10; rusted metal, three bins, 0.23, 0.13, 0.07.
static const double points[] = {1.5, 3, 10};
enum { POINT_NUMBERS = sizeof points / sizeof *points };

// A number of bins is good enough if its error is at most `tolerance` times the smallest error, or
// at most `negligible`.
static const double tolerance = 1.1, negligible = 0.1;

/// A lobe in the Lambert plane.
typedef struct sample {
    double place[2], variance, weight;
    double nearest; // squared distance to what was chosen before
} sample;

typedef struct component {
    double weight, mean[2];
    double covariance[3], inverse[3], determinant; // xx, yy, xy
    double offset; // the part of the log likelihood that does not depend on the sample
} component;

typedef struct mixture {
    component components[MOMENT_MAXIMUM_BINS];
    uint32_t count;
    double points, likelihood;
} mixture;

// Base lobes at least this broad keep the plane's arithmetic finite (PLANE_VARIANCE_MAXIMUM).
static double variance_of(double concentration) {
    return 1 / fmax(concentration, 0.2);
}

static void plane_from_direction(const double direction[3], double place[2]) {
    double scale = sqrt(2 / fmax(1 + direction[2], 1e-6));
    place[0] = direction[0] * scale;
    place[1] = direction[1] * scale;
}

// ---------------------------------------------------------------------------------------------
// Samples

static uint32_t take_samples(const lobe_scene *scene, const device_material *material,
                             sample samples[SAMPLES * LOBE_MATERIAL_MAXIMUM_LOBES]) {
    const lobe_grid grid = passes_lobe_grid(material);
    uint32_t count = 0;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        float position[2];
        material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES];
        passes_sample_position(i, SAMPLES, position);
        uint32_t found =
            passes_material_lobes_read(scene, material, (uint32_t)(position[0] * (float)grid.width),
                                       (uint32_t)(position[1] * (float)grid.height), lobes);
        for (uint32_t k = 0; k < found; k++) {
            sample *taken = &samples[count++];
            plane_from_direction(lobes[k].axis, taken->place);
            taken->variance = variance_of(lobes[k].concentration);
            taken->weight = lobes[k].weight;
        }
    }
    return count;
}

// ---------------------------------------------------------------------------------------------
// Expectation and maximisation

static void invert(component *c, double lobe_points) {
    const double *m = c->covariance;
    c->determinant = fmax(m[0] * m[1] - m[2] * m[2], 1e-16);
    c->inverse[0] = m[1] / c->determinant;
    c->inverse[1] = m[0] / c->determinant;
    c->inverse[2] = -m[2] / c->determinant;
    c->offset = log(c->weight) - 0.5 * lobe_points * log(c->determinant);
}

/// Vasconcelos, Lippman, 1998, Learning Mixture Hierarchies, Eq. 8: the log likelihood of all
/// points of a sample under a component.
static double logarithm_of_chance(const component *c, double lobe_points, const sample *s) {
    double x = s->place[0] - c->mean[0], y = s->place[1] - c->mean[1];
    double square = c->inverse[0] * x * x + c->inverse[1] * y * y + 2 * c->inverse[2] * x * y;
    double trace = s->variance * (c->inverse[0] + c->inverse[1]);
    return c->offset - 0.5 * lobe_points * (square + trace);
}

/// Computes the share [0, 1] of each component in a sample; returns the logarithm of the sum of
/// likelihoods.
static double share(const mixture *m, const sample *s, double members[MOMENT_MAXIMUM_BINS]) {
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

/// Sums of a component: weight, place, second moments and variance.
typedef struct component_sums {
    double weight, place[2], moments[3], variance;
} component_sums;

static void add(component_sums *sums, const sample *s, double weight) {
    double x = s->place[0], y = s->place[1];
    sums->weight += weight;
    sums->place[0] += weight * x;
    sums->place[1] += weight * y;
    sums->moments[0] += weight * x * x;
    sums->moments[1] += weight * y * y;
    sums->moments[2] += weight * x * y;
    sums->variance += weight * s->variance;
}

static void maximise(const component_sums *sums, double total, double lobe_points, component *c) {
    double weight = fmax(sums->weight, 1e-12);
    c->weight = fmax(sums->weight / total, 1e-9);
    if (sums->weight < 1e-9 * total)
        return;
    for (int i = 0; i < 2; i++)
        c->mean[i] = sums->place[i] / weight;
    double variance = sums->variance / weight;
    c->covariance[0] = fmax(sums->moments[0] / weight - c->mean[0] * c->mean[0], 0) + variance;
    c->covariance[1] = fmax(sums->moments[1] / weight - c->mean[1] * c->mean[1], 0) + variance;
    c->covariance[2] = sums->moments[2] / weight - c->mean[0] * c->mean[1];
    invert(c, lobe_points);
}

static void improve(mixture *m, const sample *samples, uint32_t count) {
    component_sums sums[MOMENT_MAXIMUM_BINS] = {{0}};
    double total = 0;
    m->likelihood = 0;
    for (uint32_t i = 0; i < count; i++) {
        double members[MOMENT_MAXIMUM_BINS];
        m->likelihood += samples[i].weight * share(m, &samples[i], members);
        total += samples[i].weight;
        for (uint32_t k = 0; k < m->count; k++)
            add(&sums[k], &samples[i], samples[i].weight * members[k]);
    }
    for (uint32_t k = 0; k < m->count; k++)
        maximise(&sums[k], total, m->points, &m->components[k]);
}

/// How far apart two samples are, in widths and in factors of width.
static double distance(const sample *a, const sample *b, double spread) {
    double x = a->place[0] - b->place[0], y = a->place[1] - b->place[1];
    double ratio = log(a->variance / b->variance);
    return (x * x + y * y) / (spread + sqrt(a->variance * b->variance)) + ratio * ratio;
}

/// Pseudorandom numbers in [0, 1), the same on every machine (Knuth's MMIX generator).
static double next_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/// Draws a sample with a probability that grows with its distance from all those chosen before
/// (Arthur, Vassilvitskii, 2007, k-means++).
static const sample *choose_far(sample *samples, uint32_t count, const sample *last, double spread,
                                uint64_t *state) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        samples[i].nearest = fmin(samples[i].nearest, distance(&samples[i], last, spread));
        sum += samples[i].nearest;
    }
    double target = next_number(state) * sum;
    uint32_t found = 0;
    while (found + 1 < count && (target -= samples[found].nearest) > 0)
        ++found;
    return &samples[found];
}

static void start(mixture *m, sample *samples, uint32_t count, double spread, uint64_t *state) {
    const sample *s = &samples[(uint32_t)(next_number(state) * count)];
    for (uint32_t i = 0; i < count; i++)
        samples[i].nearest = INFINITY;
    for (uint32_t k = 0; k < m->count; k++) {
        if (k > 0)
            s = choose_far(samples, count, s, spread, state);
        component *c = &m->components[k];
        *c = (component){.weight = 1.0 / m->count, .mean = {s->place[0], s->place[1]}};
        c->covariance[0] = c->covariance[1] = s->variance + 0.1 * spread;
        invert(c, m->points);
    }
}

static double spread_of(const sample *samples, uint32_t count) {
    component_sums sums = {0};
    for (uint32_t i = 0; i < count; i++)
        add(&sums, &samples[i], samples[i].weight);
    double x = sums.place[0] / sums.weight, y = sums.place[1] / sums.weight;
    return fmax((sums.moments[0] + sums.moments[1]) / sums.weight - x * x - y * y, 0) / 2;
}

static void fit(sample *samples, uint32_t count, uint32_t bins, double lobe_points, mixture *best) {
    uint64_t state = 2013;
    double spread = spread_of(samples, count);
    for (int i = 0; i < (bins > 1 ? STARTS : 1); i++) {
        mixture trial = {.count = bins, .points = lobe_points};
        start(&trial, samples, count, spread, &state);
        for (int round = 0; round < (bins > 1 ? ROUNDS : 1); round++)
            improve(&trial, samples, count);
        if (i == 0 || trial.likelihood > best->likelihood)
            *best = trial;
    }
}

// ---------------------------------------------------------------------------------------------
// Ranges

/// Texels scanned in each direction. Those between them may lie slightly outside the range, and are
/// clipped to it where the storage format demands it.
enum { SCAN = 256 };

typedef struct extremes {
    double low[2], high[2], sharpest, heaviest;
} extremes;

/// The largest mass that plane_mass in shaders/lib/lobe/plane_lobe.glsl can give this lobe, for
/// either setting of the knob "base".
static double largest_mass(const lobe_material *material, double kappa) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    double square = fmin(2 / kappa, 0.9), clamped = fmax(kappa, 1e-6);
    double projected = 0.5 * (1 + passes_mean_resultant_length(clamped / 2)) / (1 + exp(-clamped));
    double peak = clamped / -expm1(-2 * clamped);
    double mass = variance_of(kappa) * peak / (microfacet ? projected : 1);
    return microfacet ? fmax(mass, fmax(1 / (1 - square), 1 + variance_of(kappa))) : mass;
}

static void extend(extremes *range, const material_lobe *lobe) {
    double place[2];
    plane_from_direction(lobe->axis, place);
    for (int i = 0; i < 2; i++) {
        range->low[i] = fmin(range->low[i], place[i]);
        range->high[i] = fmax(range->high[i], place[i]);
    }
    range->sharpest = fmax(range->sharpest, 1 / sqrt(variance_of(lobe->concentration)));
}

/// For maps that the host cannot read: the range of any material.
static const extremes everything = {{-2, -2}, {2, 2}, 1e3, 10};

static extremes scan(const lobe_scene *scene, const device_material *material) {
    extremes range = {{2, 2}, {-2, -2}, 0.4, 1e-6};
    const lobe_grid grid = passes_lobe_grid(material);
    uint32_t columns = grid.width < SCAN ? grid.width : SCAN;
    uint32_t rows = grid.height < SCAN ? grid.height : SCAN;
    for (uint32_t i = 0; i < columns * rows; i++) {
        material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES];
        uint32_t x = (uint32_t)((uint64_t)(i % columns) * grid.width / columns);
        uint32_t y = (uint32_t)((uint64_t)(i / columns) * grid.height / rows);
        uint32_t count = passes_material_lobes_read(scene, material, x, y, lobes);
        if (count == 0)
            return everything;
        double mass = 0; // of all lobes, which one bin may get
        for (uint32_t k = 0; k < count; k++) {
            extend(&range, &lobes[k]);
            mass += lobes[k].weight * largest_mass(material->material, lobes[k].concentration);
        }
        range.heaviest = fmax(range.heaviest, mass);
    }
    return range;
}

static void set_range(const extremes *found, moment_range *range) {
    range->place[2] = 1e-3f; // of maps without any slope; not 0, because it is a divisor
    // A margin for texels that the scan skipped.
    const double margin = 1.05;
    for (int i = 0; i < 2; i++) {
        range->place[i] = (float)(0.5 * (found->low[i] + found->high[i]));
        float half = (float)(0.5 * margin * (found->high[i] - found->low[i]));
        range->place[2] = fmaxf(range->place[2], half);
    }
    range->largest[0] = (float)(margin * found->heaviest);
    range->largest[1] = (float)found->sharpest;
}

// ---------------------------------------------------------------------------------------------
// Partitions

static void set_fitted(const mixture *m, moment_partition *partition) {
    partition->bins = m->count;
    for (uint32_t i = 0; i < m->count; i++) {
        const component *c = &m->components[i];
        struct moment_bin *bin = &partition->constants.bins[i];
        bin->centre[0] = (float)c->mean[0];
        bin->centre[1] = (float)c->mean[1];
        bin->centre[2] = (float)c->offset;
        bin->centre[3] = (float)(0.5 * m->points * (c->inverse[0] + c->inverse[1]));
        for (int k = 0; k < 3; k++)
            bin->shape[k] = (float)(0.5 * m->points * c->inverse[k]);
    }
}

/// Hats are two standard deviations of the lobes' places wide. Lobes count as rough if their
/// variance is above the geometric mean of the smallest and the largest, if those differ.
static void set_hats(const sample *samples, uint32_t count, moment_partition *partition) {
    component_sums sums = {0};
    double least = INFINITY, most = 0;
    for (uint32_t i = 0; i < count; i++) {
        add(&sums, &samples[i], samples[i].weight);
        least = fmin(least, samples[i].variance);
        most = fmax(most, samples[i].variance);
    }
    float *hats = partition->constants.hats;
    for (int i = 0; i < 2; i++)
        hats[i] = (float)(sums.place[i] / fmax(sums.weight, 1e-12));
    double spread = count > 0 ? spread_of(samples, count) : 0;
    hats[2] = (float)(1 / (2 * sqrt(fmax(spread, 1e-8))));
    hats[3] = most > 1.2 * least ? (float)sqrt(least * most) : 1e9f;
    partition->bins = partition->kind == PARTITION_CAP ? 6 : 5;
}

// ---------------------------------------------------------------------------------------------
// The choice of a number

/// The bins of a patch, as a pixel whose footprint it is would see them.
static uint32_t collect(const material_patch *patch, const mixture *m,
                        component bins[MOMENT_MAXIMUM_BINS]) {
    component_sums sums[MOMENT_MAXIMUM_BINS] = {{0}};
    for (size_t i = 0; i < patch->count; i++) {
        const material_lobe *lobe = &patch->lobes[i];
        sample s = {.variance = variance_of(lobe->concentration), .weight = lobe->weight};
        double members[MOMENT_MAXIMUM_BINS];
        plane_from_direction(lobe->axis, s.place);
        share(m, &s, members);
        for (uint32_t k = 0; k < m->count; k++)
            add(&sums[k], &s, s.weight * members[k]);
    }
    uint32_t count = 0;
    for (uint32_t k = 0; k < m->count; k++) {
        if (sums[k].weight > 1e-6)
            maximise(&sums[k], 1, 1, &bins[count++]);
    }
    return count;
}

static double evaluate_bins(const component *bins, uint32_t count, const double direction[3]) {
    double place[2], sum = 0;
    plane_from_direction(direction, place);
    for (uint32_t k = 0; k < count; k++) {
        double x = place[0] - bins[k].mean[0], y = place[1] - bins[k].mean[1];
        double square = bins[k].inverse[0] * x * x + bins[k].inverse[1] * y * y +
                        2 * bins[k].inverse[2] * x * y;
        sum += bins[k].weight * exp(-0.5 * square) / (2 * M_PI * sqrt(bins[k].determinant));
    }
    return sum;
}

/// Adds to the integrals of the squared error and of the squared ground truth. Directions are drawn
/// with a density proportional to the truth, so each is weighted by its inverse.
static void add_error(const material_patch *patch, const mixture *m, double integrals[2]) {
    component bins[MOMENT_MAXIMUM_BINS];
    uint32_t count = collect(patch, m, bins);
    for (uint32_t i = 0; i < MATERIAL_PATCH_DIRECTIONS; i++) {
        double direction[3];
        passes_material_patch_draw(patch, i, direction);
        double truth = passes_material_patch_evaluate(patch, direction);
        double error = evaluate_bins(bins, count, direction) - truth;
        integrals[0] += truth > 0 ? error * error / truth : 0;
        integrals[1] += truth;
    }
}

/// Maximum number of bins chosen automatically: more bins cost more than they improve a pixel.
enum { MOST = 3 };

/// Relative L2 over all patches.
static double patch_error(const material_patch *patches, const mixture *m) {
    double integrals[2] = {0};
    for (uint32_t i = 0; i < MATERIAL_PATCHES; i++)
        add_error(&patches[i], m, integrals);
    return sqrt(integrals[0] / fmax(integrals[1], 1e-30));
}

/// Finds the fit of `bins` components with the smallest error over the patches; returns that error.
static double fit_best(const material_patch *patches, sample *samples, uint32_t count,
                       uint32_t bins, mixture *best) {
    double least = INFINITY;
    for (int i = 0; i < (bins > 1 ? POINT_NUMBERS : 1); i++) {
        mixture trial;
        fit(samples, count, bins, points[i], &trial);
        double error = patch_error(patches, &trial);
        if (i == 0 || error < least) {
            *best = trial;
            least = error;
        }
    }
    return least;
}

/// `bins`: their number; 0 for the smallest number that is about as good for the patches as the
/// best.
static void choose(const material_patch *patches, sample *samples, uint32_t count, uint32_t bins,
                   mixture *chosen) {
    if (bins > 0) {
        fit_best(patches, samples, count, bins, chosen);
        return;
    }
    mixture candidates[MOST];
    double errors[MOST], least = INFINITY;
    for (uint32_t k = 0; k < MOST; k++) {
        errors[k] = fit_best(patches, samples, count, k + 1, &candidates[k]);
        least = fmin(least, errors[k]);
    }
    uint32_t number = 0;
    while (errors[number] > fmax(tolerance * least, negligible))
        ++number;
    *chosen = candidates[number];
}

/// Uses one bin for all lobes if the patches cannot be read. False: out of memory.
static bool choose_for_material(const lobe_allocator *allocator, const lobe_scene *scene,
                                const device_material *material, sample *samples, uint32_t count,
                                uint32_t bins, mixture *chosen) {
    *chosen = (mixture){.count = 1, .components = {{.weight = 1, .determinant = 1}}};
    material_patch *patches = lobe_allocate(allocator, MATERIAL_PATCHES, sizeof *patches);
    if (!patches)
        return false;
    bool readable = count > 0;
    for (uint32_t i = 0; readable && i < MATERIAL_PATCHES; i++)
        readable = passes_material_patch_read(scene, material, i, &patches[i]);
    if (readable)
        choose(patches, samples, count, bins, chosen);
    lobe_release(patches);
    return true;
}

lobe_result passes_moment_partition_make(const device_scene *uploaded, uint32_t index,
                                         uint32_t kind, uint32_t bins, const lobe_host *host,
                                         moment_partition *partition) {
    const lobe_scene *scene = uploaded->scene;
    const device_material *material = &uploaded->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    sample samples[SAMPLES * LOBE_MATERIAL_MAXIMUM_LOBES];
    uint32_t count = take_samples(scene, material, samples);
    memset(partition, 0, sizeof *partition);
    partition->kind = kind;
    partition->width = grid.width;
    partition->height = grid.height;
    extremes range = scan(scene, material);
    set_range(&range, &partition->constants.range);
    if (kind != PARTITION_FITTED) {
        set_hats(samples, count, partition);
        return LOBE_OK;
    }
    mixture fitted;
    if (!choose_for_material(lobe_host_allocator(host), scene, material, samples, count, bins,
                             &fitted))
        return LOBE_ERROR_OUT_OF_MEMORY;
    set_fitted(&fitted, partition);
    return LOBE_OK;
}
