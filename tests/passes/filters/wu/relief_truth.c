#include "tests/passes/filters/wu/relief_truth.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------
// Random numbers

static uint64_t mixed(uint64_t value) {
    value = (value ^ (value >> 31)) * 0x7fb5d329728ea185u;
    value = (value ^ (value >> 27)) * 0x81dadef4bc2dd44du;
    return value ^ (value >> 33);
}

typedef struct random_numbers {
    uint64_t state;
} random_numbers;

static double next(random_numbers *numbers) {
    numbers->state += 0x9e3779b97f4a7c15u;
    return (double)(mixed(numbers->state) >> 11) * 0x1p-53;
}

void relief_truth_directions(double directions[TRUTH_DIRECTIONS][3]) {
    const double most = pow(sin(82 * M_PI / 180), 2);
    for (int i = 0; i < TRUTH_DIRECTIONS; i++) {
        const double square = most * (i + 0.5) / TRUTH_DIRECTIONS, turn = 2.39996323 * i + 0.7;
        directions[i][0] = sqrt(square) * cos(turn);
        directions[i][1] = sqrt(square) * sin(turn);
        directions[i][2] = sqrt(1 - square);
    }
}

// ---------------------------------------------------------------------------------------------
// The relief

typedef struct field {
    int width, height;
    double *heights;
    double largest;
} field;

static int wrapped(int i, int size) {
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

static double vertex(const field *f, int x, int y) {
    return f->heights[wrapped(y, f->height) * f->width + wrapped(x, f->width)];
}

static double mix(double a, double b, double part) {
    return a + (b - a) * part;
}

/// Height on the side through (k, y), along (x, k), and on the diagonal through (x, x - k).
static double on_column(const field *f, double k, double y) {
    const int below = (int)floor(y);
    return mix(vertex(f, (int)k, below), vertex(f, (int)k, below + 1), y - below);
}

static double on_row(const field *f, double k, double x) {
    const int before = (int)floor(x);
    return mix(vertex(f, before, (int)k), vertex(f, before + 1, (int)k), x - before);
}

static double on_diagonal(const field *f, double k, double x) {
    const int before = (int)floor(x);
    return mix(vertex(f, before, before - (int)k), vertex(f, before + 1, before + 1 - (int)k),
               x - before);
}

typedef double (*height_on)(const field *f, double k, double along);

/// Where the ray is below one of the parallel sides first, if before `first`. The sides are where
/// `place` is whole, which changes by `rate`; `along` says where on a side.
static double first_below(const field *f, height_on on, double place, double rate, double along,
                          double along_rate, const double origin[3], const double direction[3],
                          double first) {
    if (fabs(rate) < 1e-12)
        return first;
    double k = rate > 0 ? floor(place) + 1 : ceil(place) - 1;
    for (;; k += rate > 0 ? 1 : -1) {
        const double t = (k - place) / rate, z = origin[2] + t * direction[2];
        if (t >= first || (direction[2] >= 0 && z > f->largest))
            return first;
        if (t > 1e-7 && z < on(f, k, along + t * along_rate) - 1e-9)
            return t;
    }
}

/// Where the ray is known to be below the relief; infinity: nowhere.
static double first_crossing(const field *f, const double o[3], const double d[3]) {
    double first = INFINITY;
    if (d[2] < 0) // it is below the lowest height somewhere
        first = (o[2] + f->largest + 1e6) / -d[2];
    first = first_below(f, on_column, o[0], d[0], o[1], d[1], o, d, first);
    first = first_below(f, on_row, o[1], d[1], o[0], d[0], o, d, first);
    return first_below(f, on_diagonal, o[0] - o[1], d[0] - d[1], o[0], d[0], o, d, first);
}

typedef struct facet {
    double point[3], normal[3];
} facet;

static facet facet_at(const field *f, double x, double y) {
    const int column = (int)floor(x), row = (int)floor(y);
    const double u = x - column, v = y - row;
    const double a = vertex(f, column, row), b = vertex(f, column + 1, row),
                 c = vertex(f, column, row + 1), d = vertex(f, column + 1, row + 1);
    const double along = u < v ? d - c : b - a, down = u < v ? c - a : d - b;
    const double length = sqrt(1 + along * along + down * down);
    return (facet){{x, y, a + along * u + down * v}, {-along / length, -down / length, 1 / length}};
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool meets(const field *f, const double origin[3], const double direction[3], facet *hit) {
    const double t = first_crossing(f, origin, direction);
    if (isinf(t))
        return false;
    // The facet that ends where the ray is below, met before that.
    const double back = t - 1e-6;
    *hit = facet_at(f, origin[0] + back * direction[0], origin[1] + back * direction[1]);
    double between[3];
    for (int k = 0; k < 3; k++)
        between[k] = hit->point[k] - origin[k];
    const double met = dot(between, hit->normal) / dot(direction, hit->normal);
    const double place = met >= 0 && met <= t ? met : back;
    *hit = facet_at(f, origin[0] + place * direction[0], origin[1] + place * direction[1]);
    return true;
}

// ---------------------------------------------------------------------------------------------
// Paths

static double light_at(const field *f, const facet *at, const double direction[3]) {
    const double cosine = dot(at->normal, direction);
    return cosine > 0 && isinf(first_crossing(f, at->point, direction)) ? cosine : 0;
}

static void turn_from(const facet *at, random_numbers *numbers, double direction[3]) {
    const double *n = at->normal;
    const double square = next(numbers), angle = 2 * M_PI * next(numbers);
    const double local[3] = {sqrt(square) * cos(angle), sqrt(square) * sin(angle),
                             sqrt(1 - square)};
    const double side = hypot(n[0], n[2]);
    const double along[3] = {n[2] / side, 0, -n[0] / side};
    const double across[3] = {n[1] * along[2], n[2] * along[0] - n[0] * along[2], -n[1] * along[0]};
    for (int k = 0; k < 3; k++)
        direction[k] = local[0] * along[k] + local[1] * across[k] + local[2] * n[k];
}

/// A point's light towards every direction, by way of its own facet and of others behind it.
typedef struct point_light {
    double own[TRUTH_DIRECTIONS], all[TRUTH_DIRECTIONS];
} point_light;

static point_light follow(const field *f, const double directions[][3], facet at, double albedo,
                          uint32_t bounces, random_numbers *numbers) {
    point_light light;
    for (int i = 0; i < TRUTH_DIRECTIONS; i++)
        light.all[i] = light.own[i] = light_at(f, &at, directions[i]);
    double throughput = 1;
    for (uint32_t k = 1; k < bounces; k++) {
        double direction[3];
        turn_from(&at, numbers, direction);
        if (!meets(f, at.point, direction, &at))
            break;
        throughput *= albedo;
        for (int i = 0; i < TRUTH_DIRECTIONS; i++)
            light.all[i] += throughput * light_at(f, &at, directions[i]);
    }
    return light;
}

static field field_of(const lobe_image *map) {
    field f = {(int)map->width, (int)map->height, NULL, -INFINITY};
    f.heights = calloc((size_t)map->width * map->height, sizeof *f.heights);
    if (!f.heights)
        abort();
    for (uint32_t i = 0; i < map->width * map->height; i++) {
        f.heights[i] = (double)((const float *)map->texels)[4 * (size_t)i];
        f.largest = fmax(f.largest, f.heights[i]);
    }
    return f;
}

static void add_point(relief_truth *truth, uint32_t cell, int half, const point_light *light,
                      double area, double albedo, uint32_t points) {
    double *sums = truth->light[half] + (size_t)cell * TRUTH_DIRECTIONS * TRUTH_DIRECTIONS;
    for (int o = 0; o < TRUTH_DIRECTIONS; o++) {
        const double seen = area * light->own[o] / points;
        truth->visible[cell * TRUTH_DIRECTIONS + (uint32_t)o] += seen / 2;
        for (int i = 0; i < TRUTH_DIRECTIONS && seen > 0; i++)
            sums[i * TRUTH_DIRECTIONS + o] += albedo / M_PI * seen * light->all[i];
    }
}

relief_truth relief_truth_of(const lobe_image *map, uint32_t texels, double albedo,
                             uint32_t bounces, uint32_t points) {
    const uint32_t columns = map->width / texels;
    const size_t pairs = (size_t)TRUTH_DIRECTIONS * TRUTH_DIRECTIONS;
    relief_truth truth = {.cells = columns * (map->height / texels)};
    double directions[TRUTH_DIRECTIONS][3];
    relief_truth_directions(directions);
    field f = field_of(map);
    truth.visible = calloc((size_t)truth.cells * TRUTH_DIRECTIONS, sizeof(double));
    for (int half = 0; half < 2; half++)
        truth.light[half] = calloc(truth.cells * pairs, sizeof(double));
    if (!truth.visible || !truth.light[0] || !truth.light[1])
        abort();
    for (uint32_t i = 0; i < truth.cells * 2 * points; i++) {
        const uint32_t cell = i / (2 * points), k = i % points;
        random_numbers numbers = {mixed(i + 1)};
        // Strata along x, an irrational lattice along y.
        const double u = (k + next(&numbers)) / points,
                     v = fmod(0.6180339887498949 * k + next(&numbers) / points, 1);
        const facet at = facet_at(&f, (cell % columns + u) * texels, (cell / columns + v) * texels);
        const point_light light =
            follow(&f, (const double(*)[3])directions, at, albedo, bounces, &numbers);
        add_point(&truth, cell, (int)(i / points % 2), &light, 1 / at.normal[2], albedo, points);
    }
    free(f.heights);
    return truth;
}

void relief_truth_free(relief_truth *truth) {
    for (int half = 0; half < 2; half++)
        free(truth->light[half]);
    free(truth->visible);
    *truth = (relief_truth){0};
}
