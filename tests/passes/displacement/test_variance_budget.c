// Slopes that displaced triangles draw, and those that the filter's statistics have of the rest,
// are together those of the map, whatever the distance of vertices (Dupuy et al. 2013, section 5).
//
// `test_displacement_variance_budget maps` prints both for maps made here, `... FILE...` for height
// maps in files.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/filters/wu/sample_reliefs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { QUADS = 3, EXTENT = 128, LEVELS = 8, NUMBERS = 4 };

/// Of slopes over a square of a level: means of both, and of their squares.
typedef struct slope_square {
    double numbers[NUMBERS];
} slope_square;

typedef struct slope_pyramid {
    uint32_t side;
    slope_square *levels[LEVELS + 1];
} slope_pyramid;

typedef struct budget {
    double drawn, rest; ///< mean squares of slopes, over that of the map's
} budget;

static double texel(const lobe_image *map, uint32_t x, uint32_t y) {
    return (double)((const float *)map->texels)[4 * (y % map->width * map->width + x % map->width)];
}

/// As passes/upload/heights/height_normals.c, without their rounding.
static void slopes_of(const lobe_image *map, double scale, uint32_t x, uint32_t y, double s[2]) {
    const uint32_t side = map->width;
    const double factor = 0.5 * scale * side;
    s[0] = factor * (texel(map, x + 1, y) - texel(map, x + side - 1, y));
    s[1] = factor * (texel(map, x, y + 1) - texel(map, x, y + side - 1));
}

static void interpolated_slopes(const lobe_image *map, double scale, double x, double y,
                                double s[2]) {
    const uint32_t side = map->width;
    const double left = floor(x - 0.5), top = floor(y - 0.5);
    const double right_part = x - 0.5 - left, lower_part = y - 0.5 - top;
    s[0] = s[1] = 0;
    for (int i = 0; i < 4; i++) {
        double own[2];
        const double weight =
            (i & 1 ? right_part : 1 - right_part) * (i & 2 ? lower_part : 1 - lower_part);
        slopes_of(map, scale, (uint32_t)(left + side + (i & 1)), (uint32_t)(top + side + (i >> 1)),
                  own);
        for (int k = 0; k < 2; k++)
            s[k] += weight * own[k];
    }
}

/// Points of a texel at which interpolated products have their mean over it
/// (lib/map/texel_point.glsl).
static slope_square square_of_texel(const lobe_image *map, double scale, uint32_t x, uint32_t y) {
    slope_square square = {{0}};
    for (int i = 0; i < 4; i++) {
        double s[2];
        interpolated_slopes(map, scale, x + 0.5 + (i & 1 ? 1 : -1) / sqrt(12),
                            y + 0.5 + (i & 2 ? 1 : -1) / sqrt(12), s);
        for (int k = 0; k < 2; k++) {
            square.numbers[k] += 0.25 * s[k];
            square.numbers[2 + k] += 0.25 * s[k] * s[k];
        }
    }
    return square;
}

static slope_pyramid pyramid_of(const lobe_image *map, double scale) {
    slope_pyramid p = {.side = map->width};
    for (int level = 0; level <= LEVELS; level++) {
        const uint32_t side = p.side >> level;
        p.levels[level] = calloc((size_t)side * side, sizeof *p.levels[level]);
        assert_non_null(p.levels[level]);
        for (uint32_t i = 0; i < side * side; i++) {
            const uint32_t x = i % side, y = i / side;
            if (level == 0)
                p.levels[0][i] = square_of_texel(map, scale, x, y);
            for (int k = 0; level > 0 && k < 4 * NUMBERS; k++)
                p.levels[level][i].numbers[k / 4] +=
                    0.25 * p.levels[level - 1][(2 * y + (k >> 1 & 1)) * 2 * side + 2 * x + (k & 1)]
                               .numbers[k / 4];
        }
    }
    return p;
}

static void pyramid_free(slope_pyramid *p) {
    for (int level = 0; level <= LEVELS; level++)
        free(p->levels[level]);
}

static void add_bilinear(const slope_pyramid *p, int level, const double uv[2], double weight,
                         slope_square *sum) {
    const uint32_t side = p->side >> level;
    const double x = uv[0] * side + side - 0.5, y = uv[1] * side + side - 0.5;
    for (int i = 0; i < 4; i++) {
        const uint32_t column = (uint32_t)x + (i & 1), row = (uint32_t)y + (i >> 1 & 1);
        const double part =
            (i & 1 ? x - floor(x) : 1 - x + floor(x)) * (i & 2 ? y - floor(y) : 1 - y + floor(y));
        for (int k = 0; k < NUMBERS; k++)
            sum->numbers[k] +=
                weight * part * p->levels[level][row % side * side + column % side].numbers[k];
    }
}

/// Trace of the mean covariance at a level, as fetch_level in shaders/shading/slope_maps.glsl.
static double mean_covariance(const slope_pyramid *p, double level) {
    enum { POINTS = 100 };
    const double fetched = fmax(level, 1);
    const int first = (int)fetched;
    double sum = 0;
    for (int i = 0; i < POINTS * POINTS; i++) {
        const double uv[2] = {(i % POINTS + 0.37) / POINTS, (i / POINTS + 0.61) / POINTS}; // NOLINT
        slope_square square = {{0}};
        add_bilinear(p, first, uv, 1 - (fetched - first), &square);
        if (first < LEVELS)
            add_bilinear(p, first + 1, uv, fetched - first, &square);
        for (int k = 0; k < 2; k++)
            sum += square.numbers[2 + k] - square.numbers[k] * square.numbers[k];
    }
    return fmin(level, 1) * sum / (POINTS * POINTS);
}

/// Mean square of the triangles' slopes over the plane. `least`: the area, twice, below which they
/// are slivers where patches of different sizes meet.
static double drawn_squares(const drawn_geometry *g, double least) {
    double sum = 0, area = 0;
    for (uint32_t i = 0; i < g->triangle_count; i++) {
        double edges[2][3], normal[3];
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < 3; k++)
                edges[e][k] =
                    (double)(g->vertices[g->indices[3 * i + 1 + (uint32_t)e]].position[k] -
                             g->vertices[g->indices[3 * i]].position[k]);
        for (int k = 0; k < 3; k++)
            normal[k] = edges[0][(k + 1) % 3] * edges[1][(k + 2) % 3] -
                        edges[0][(k + 2) % 3] * edges[1][(k + 1) % 3];
        const double part = fabs(normal[1]);
        if (part < least)
            continue;
        area += part;
        sum += (normal[0] * normal[0] + normal[2] * normal[2]) / part;
    }
    return sum / area;
}

/// Tiles of one metre, `texels` of the map between vertices at most; the mean over phases of the
/// grid.
static budget budget_at(fixture *f, const lobe_image *map, double scale, const slope_pyramid *p,
                        double texels) {
    enum { PHASES = 3 };
    double total = 0, drawn = 0;
    for (uint32_t i = 0; i < p->side * p->side; i++)
        total += (p->levels[0][i].numbers[2] + p->levels[0][i].numbers[3]) / (p->side * p->side);
    for (int phase = 0; phase < PHASES; phase++) {
        char spacing[64];
        lobe_image copy = map_image(LOBE_FORMAT_RGBA32_FLOAT, map->width, map->width);
        memcpy(copy.texels, map->texels, 16 * (size_t)map->width * map->width);
        lobe_scene *scene = plane_with_heights(QUADS, 1, copy, (float)scale, 1);
        for (size_t i = 0; i < scene->meshes[0].vertex_count; i++)
            for (int k = 0; k < 2; k++)
                scene->meshes[0].vertices[i].texture_coordinates[0][k] +=
                    (float)(phase * (k ? 0.37 : 0.23) * texels / map->width);
        snprintf(spacing, sizeof spacing, "pixels_per_vertex=%g", texels * EXTENT / map->width);
        drawn_geometry g = displaced_geometry_of(f, scene, EXTENT, spacing);
        assert_true(g.triangle_count > 0);
        drawn += drawn_squares(&g, 1e-3 * pow(texels / map->width, 2)) / PHASES;
        drawn_geometry_free(&g);
        lobe_scene_destroy(&scene);
    }
    return (budget){drawn / total, mean_covariance(p, log2(texels)) / total};
}

/// Of a map with 256 texels a side and heights in [0, 1].
static void print_budgets(fixture *f, const char *name, const lobe_image *map, double scale) {
    slope_pyramid p = pyramid_of(map, scale);
    printf("%s: texels between vertices, drawn, rest, sum\n", name);
    for (double texels = 1; texels <= 64; texels *= sqrt(2)) {
        const budget b = budget_at(f, map, scale, &p, texels);
        printf("%8.3g %6.3f %6.3f %6.3f\n", texels, b.drawn, b.rest, b.drawn + b.rest);
    }
    pyramid_free(&p);
}

/// Heights in texels' widths.
static void print_relief(fixture *f, const char *name, lobe_image map) {
    const double range = sample_relief_normalise(&map);
    print_budgets(f, name, &map, range / map.width);
    lobe_image_free(&map);
}

static void print_made(fixture *f) {
    float scale;
    lobe_image waves = gaussian_heights(SAMPLE_EXTENT, 0.5, 11, &scale);
    print_budgets(f, "waves", &waves, (double)scale);
    lobe_image_free(&waves);
    print_relief(f, "twill", sample_relief_twill());
    print_relief(f, "bumps", sample_relief_bumps(90125));
    print_relief(f, "noise", sample_relief_noise(SAMPLE_EXTENT, 15, 5150));
}

static void slopes_are_counted_once(void **state) {
    float scale;
    lobe_image map = gaussian_heights(SAMPLE_EXTENT, 0.5, 11, &scale);
    slope_pyramid p = pyramid_of(&map, (double)scale);
    for (double texels = 4; texels <= 64; texels *= 4) {
        const budget b = budget_at(*state, &map, (double)scale, &p, texels);
        if (fabs(b.drawn + b.rest - 1) > 0.05)
            fail_msg("%g texels: %g drawn, %g not", texels, b.drawn, b.rest);
    }
    pyramid_free(&p);
    lobe_image_free(&map);
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_counted_once)};
    if (count < 2)
        return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
    void *state = NULL;
    fixture_create(&state);
    fixture *f = state;
    for (int i = 1; i < count; i++) {
        if (strcmp(arguments[i], "maps") == 0)
            print_made(f);
        else
            print_relief(f, arguments[i], sample_relief_load(arguments[i], &f->host));
    }
    fixture_destroy(&state);
    return 0;
}
