// The parts of a model of the filter "wu": heights against their closed form, and the light that is
// found along paths against energy that is known.

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/filters/wu/build.h"
#include "passes/upload/device_scene_parts.h"
#include "tests/passes/filters/displaced/relief_plane.h"
#include "tests/passes/support/pass_run.h"

static const wu_kind kind = {.lobes = 6, .angular = 9, .patches = 2, .points = 1024, .bounces = 16};

typedef struct model_run {
    pass_run run;
    lobe_scene *scene;
    wu_build build;
} model_run;

static void begin(model_run *model, fixture *f, lobe_image map, const wu_kind *asked) {
    const lobe_material material = relief_material(1);
    model->scene = relief_plane(&material, map, (double[]){0, 0, 1}, 1);
    scene_end(model->scene);
    pass_run_begin(&model->run, f, model->scene, "wu", (const char *const[]){NULL});
    assert_int_equal(passes_device_scene_upload_heights(model->run.scene, &f->host), LOBE_OK);
    model->build = passes_wu_begin(&model->run.context, 0, asked, false);
}

static void end(model_run *model) {
    pass_run_end(&model->run);
    lobe_scene_destroy(&model->scene);
}

static const void *data_of(const model_run *model, lobe_resource buffer, size_t expected) {
    size_t size = 0;
    const void *data = lobe_graph_data(model->build.graph, buffer, &size);
    assert_int_equal(size, expected);
    return data;
}

// ---------------------------------------------------------------------------------------------
// Heights

/// A relief of several waves and of noise, with mean slopes that no vertices show exactly.
static double rough(uint32_t column, uint32_t row) {
    const uint32_t mixed = (column * 7919 + row * 104729) * 2654435761u;
    return 5 * sin(0.19635 * column) * cos(0.0981748 * row) + 2 * sin(0.589 * column + 0.4 * row) +
           1.5 * (double)(mixed >> 8) / (1 << 24);
}

enum { MOST_CELLS = 256 };

/// Mean slopes of the two triangles of each quad under a cell.
static void mean_slope(const lobe_image *map, const struct wu_level *level, uint32_t x, uint32_t y,
                       double slope[2]) {
    const uint32_t first[2] = {x * map->width / level->width, y * map->height / level->height};
    const uint32_t last[2] = {(x + 1) * map->width / level->width,
                              (y + 1) * map->height / level->height};
    slope[0] = slope[1] = 0;
    for (uint32_t j = first[1]; j < last[1]; j++) {
        for (uint32_t i = first[0]; i < last[0]; i++) {
            const double h00 = relief_map_height(map, i, j), h10 = relief_map_height(map, i + 1, j),
                         h01 = relief_map_height(map, i, j + 1),
                         h11 = relief_map_height(map, i + 1, j + 1);
            slope[0] += ((h10 - h00) + (h11 - h01)) / 2;
            slope[1] += ((h11 - h10) + (h01 - h00)) / 2;
        }
    }
    for (int k = 0; k < 2; k++)
        slope[k] /= (double)(last[0] - first[0]) * (last[1] - first[1]);
}

/// h = (conj Gx sx + conj Gy sy) / (|Gx|^2 + |Gy|^2 + w L^2) for each frequency; the mean is 0.
static complex double height_of_frequency(const struct wu_level *level, double alpha, double beta,
                                          const complex double slope[2]) {
    const complex double x = cexp(I * alpha), y = cexp(I * beta);
    const complex double gx = (x - 1) * (y + 1) / 2 * (double)(level->unit / level->spacing_x),
                         gy = (x + 1) * (y - 1) / 2 * (double)(level->unit / level->spacing_y);
    const double laplacian = 2 * cos(alpha) + 2 * cos(beta) - 4;
    return (conj(gx) * slope[0] + conj(gy) * slope[1]) /
           (creal(gx * conj(gx)) + creal(gy * conj(gy)) + 0.01 * laplacian * laplacian);
}

static void closed_form(const lobe_image *map, const struct wu_level *level, double *heights) {
    const uint32_t width = level->width, height = level->height, count = width * height;
    double slopes[MOST_CELLS][2];
    assert_true(count <= MOST_CELLS);
    for (uint32_t i = 0; i < count; i++)
        mean_slope(map, level, i % width, i / width, slopes[i]);
    memset(heights, 0, count * sizeof *heights);
    for (uint32_t k = 1; k < count; k++) {
        const double alpha = 2 * M_PI * (k % width) / width, beta = 2 * M_PI * (k / width) / height;
        complex double sums[2] = {0, 0};
        for (uint32_t i = 0; i < count; i++) {
            const complex double wave = cexp(-I * (alpha * (i % width) + beta * (i / width)));
            sums[0] += wave * slopes[i][0];
            sums[1] += wave * slopes[i][1];
        }
        const complex double found = height_of_frequency(level, alpha, beta, sums);
        for (uint32_t i = 0; i < count; i++)
            heights[i] +=
                creal(found * cexp(I * (alpha * (i % width) + beta * (i / width)))) / count;
    }
}

static void check_heights(const float *found, const double *expected, uint32_t count,
                          uint32_t level) {
    double error = 0, sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        error += pow((double)found[i] - expected[i], 2);
        sum += expected[i] * expected[i];
    }
    if (!(sqrt(error) <= 1e-3 * sqrt(sum) + 1e-6))
        fail_msg("level %u of %u cells: off by %g of %g", level, count, sqrt(error), sqrt(sum));
}

/// A weave whose cells of 8 texels are level, although the heights of their corners differ.
static double weave(uint32_t column, uint32_t row) {
    const double down = sin(M_PI * row / 8), side = row / 8 % 2 ? -1 : 1;
    return 40 * fabs(down) * fmax(side * sin(M_PI * column / 8), 0);
}

static void check_levels(fixture *f, uint32_t width, uint32_t height, relief_height height_at) {
    lobe_image map = relief_map(width, height, height_at);
    double expected[WU_LEVELS][MOST_CELLS];
    struct wu_constants constants = {0};
    passes_wu_place_levels(width, height, &kind, &constants);
    for (uint32_t i = 0; i < constants.level_count; i++)
        closed_form(&map, &constants.levels[i], expected[i]);
    model_run model;
    begin(&model, f, map, &kind);
    relief reliefs[WU_LEVELS];
    for (uint32_t i = 0; i < constants.level_count; i++) {
        reliefs[i] = passes_wu_add_low_relief(&model.build, i);
        lobe_graph_read_back(model.build.graph, reliefs[i].heights, (lobe_range){0});
    }
    pass_run_execute(&model.run);
    for (uint32_t i = 0; i < constants.level_count; i++)
        check_heights(data_of(&model, reliefs[i].heights,
                              (size_t)reliefs[i].constants.width * reliefs[i].constants.height *
                                  sizeof(float)),
                      expected[i], constants.levels[i].width * constants.levels[i].height, i);
    end(&model);
}

static void coarse_heights_are_the_closed_form(void **state) {
    static const uint32_t sizes[][2] = {{128, 128}, {128, 64}, {67, 45}, {7, 100}, {3, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        check_levels(*state, sizes[i][0], sizes[i][1], rough);
    check_levels(*state, 128, 128, weave);
}

// ---------------------------------------------------------------------------------------------
// Light

static double level_map(uint32_t column, uint32_t row) {
    (void)column;
    (void)row;
    return 3;
}

static double groove(uint32_t column, uint32_t row) {
    (void)row;
    return fabs((double)column - 8);
}

static double waves(uint32_t column, uint32_t row) {
    const double x = 2 * M_PI * column / 32, y = 2 * M_PI * row / 32;
    return 8 * sin(x) * cos(y) + 3 * sin(3 * x + y);
}

/// Reads back what paths bring from each direction to each, and makes the models.
static void begin_light(model_run *model, fixture *f, uint32_t width, relief_height height_at,
                        const wu_kind *asked) {
    begin(model, f, relief_map(width, 32, height_at), asked);
    wu_build *build = &model->build;
    passes_wu_add_paths(build);
    for (uint32_t i = 0; i < build->models.constants.level_count; i++) {
        const relief low = passes_wu_add_low_relief(build, i);
        passes_wu_add_cells(build, i, &low);
        passes_wu_add_scaling(build, i);
    }
    const lobe_resource read[] = {build->direct, build->indirect, build->models.ratios,
                                  build->models.cells, build->models.whole};
    for (size_t i = 0; i < sizeof read / sizeof *read; i++)
        lobe_graph_read_back(build->graph, read[i], (lobe_range){0});
    pass_run_execute(&model->run);
}

enum { DIRECTIONS = 81, PAIRS = DIRECTIONS * DIRECTIONS, PATCHES = 4 };

/// A level map shows what its lobes do, but for their width, and no light between facets.
static void a_level_map_is_not_scaled(void **state) {
    model_run model;
    begin_light(&model, *state, 32, level_map, &kind);
    const wu_models *models = &model.build.models;
    const uint32_t levels = models->constants.level_count;
    const float *ratios = data_of(&model, models->ratios, levels * PAIRS * 2 * sizeof(float));
    for (uint32_t i = 0; i < levels * PAIRS; i++)
        if (!(fabsf(ratios[2 * i] - 1) <= 6e-3f && ratios[2 * i + 1] == 0))
            fail_msg("pair %u: scaled by %g and %g", i, (double)ratios[2 * i],
                     (double)ratios[2 * i + 1]);
    const struct wu_cell *cell = data_of(
        &model, models->cells, (size_t)models->bytes - (levels * PAIRS * 2 + 4) * sizeof(float));
    assert_float_equal(cell->numerator[0] / cell->denominator[0], 1, 2e-3);
    assert_true(cell->numerator[1] == 0);
    end(&model);
}

static float scaling_of(const struct wu_cell *cell) {
    return cell->numerator[0] / cell->denominator[0];
}

/// From the middle of one patch to that of the next T goes in even steps, of which there are four.
static void patches_have_no_borders(void **state) {
    enum { ACROSS = 8 };
    model_run model;
    begin_light(&model, *state, 8 * ACROSS, waves, &kind);
    const struct wu_level *last =
        &model.build.models.constants.levels[model.build.models.constants.level_count - 1];
    const struct wu_cell *cells =
        data_of(&model, model.build.models.cells, (last->first_cell + 1) * sizeof(struct wu_cell));
    float least = INFINITY, most = -INFINITY, step = 0;
    for (int i = 0; i < ACROSS; i++) {
        const float here = scaling_of(&cells[i]), next = scaling_of(&cells[(i + 1) % ACROSS]);
        least = fminf(least, here);
        most = fmaxf(most, here);
        step = fmaxf(step, fabsf(next - here));
    }
    if (!(most > least && step <= 0.4F * (most - least)))
        fail_msg("from %g to %g by steps of %g", (double)least, (double)most, (double)step);
    end(&model);
}

/// White valleys of slope 1 reflect 1 - pi sqrt(2) / 16 = 0.7223 of the light at once.
static void valleys_reflect_their_closed_form(void **state) {
    model_run model;
    begin_light(&model, *state, 16, groove, &kind);
    const float *energy = data_of(&model, model.build.models.whole, 4 * sizeof(float));
    assert_float_equal(energy[0], 0.7223, 0.01);
    end(&model);
}

/// The mean over the map of what paths bring from direction i to j, both ways.
static double light_between(const float *direct, const float *indirect, uint32_t i, uint32_t j) {
    double sum = 0;
    for (uint32_t k = 0; k < PATCHES; k++)
        sum += (double)direct[k * PAIRS + i * DIRECTIONS + j] +
               (double)indirect[k * PAIRS + i * DIRECTIONS + j];
    return sum / PATCHES;
}

static double product_of_cosines(const double normal[3], const double directions[2][3]) {
    double product = 1;
    for (int k = 0; k < 2; k++) {
        double cosine = 0;
        for (int i = 0; i < 3; i++)
            cosine += normal[i] * directions[k][i];
        product *= fmax(cosine, 0);
    }
    return product;
}

/// The mean of the product over a von Mises-Fisher lobe, by 32 rings of equal weight.
static double product_of_lobe(const float lobe[4], const double directions[2][3]) {
    enum { RINGS = 32, PLACES = 16 };
    const double weight = sqrt((double)(lobe[0] * lobe[0] + lobe[1] * lobe[1] + lobe[2] * lobe[2]));
    if (weight == 0)
        return 0;
    const double axis[3] = {lobe[0] / weight, lobe[1] / weight, lobe[2] / weight};
    const double side = hypot(axis[0], axis[2]);
    const double along[3] = {axis[2] / side, 0, -axis[0] / side};
    const double across[3] = {axis[1] * along[2], axis[2] * along[0] - axis[0] * along[2],
                              -axis[1] * along[0]};
    double sum = 0;
    for (int i = 0; i < RINGS * PLACES; i++) {
        const double part = (i / PLACES + 0.5) / RINGS, turn = 2 * M_PI * (i % PLACES) / PLACES;
        const double concentration = (double)lobe[3];
        const double cosine = 1 + log(part + (1 - part) * exp(-2 * concentration)) / concentration;
        const double sine = sqrt(fmax(1 - cosine * cosine, 0));
        double normal[3];
        for (int k = 0; k < 3; k++)
            normal[k] = cosine * axis[k] + sine * (cos(turn) * along[k] + sin(turn) * across[k]);
        sum += product_of_cosines(normal, directions);
    }
    return weight * sum / (RINGS * PLACES);
}

/// The same over the facets under a cell of the first level, weighted with their areas.
static double product_of_facets(relief_height height_at, uint32_t cell, uint32_t across,
                                const double directions[2][3]) {
    double sum = 0;
    for (uint32_t i = 0; i < 128; i++) {
        const uint32_t x = cell % across * 8 + i / 2 % 8, y = cell / across * 8 + i / 16;
        const double h00 = height_at(x % 32, y % 32), h11 = height_at((x + 1) % 32, (y + 1) % 32),
                     h10 = height_at((x + 1) % 32, y % 32), h01 = height_at(x % 32, (y + 1) % 32);
        const double slope[2] = {i % 2 ? h11 - h01 : h10 - h00, i % 2 ? h01 - h00 : h11 - h10};
        const double area = sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
        const double normal[3] = {-slope[0] / area, -slope[1] / area, 1 / area};
        sum += area * product_of_cosines(normal, directions) / 128;
    }
    return sum;
}

/// The mean over cells and pairs of directions, relative to the mean.
static double error_of_lobes(const struct wu_cell *cells, uint32_t lobes) {
    double error = 0, total = 0;
    for (uint32_t i = 0; i < 16 * 9; i++) {
        double directions[2][3];
        for (int k = 0; k < 2; k++) {
            const double tilt = 0.3 + 0.45 * (k ? i % 3 : i / 3 % 3), turn = 2.1 * i + 3.3 * k;
            directions[k][0] = sin(tilt) * cos(turn);
            directions[k][1] = sin(tilt) * sin(turn);
            directions[k][2] = cos(tilt);
        }
        double found = 0;
        for (uint32_t k = 0; k < lobes; k++)
            found += product_of_lobe(cells[i / 9].lobes[k], directions);
        const double expected = product_of_facets(waves, i / 9, 4, directions);
        error += fabs(found - expected);
        total += expected;
    }
    return error / total;
}

/// The bound is a fifth above what was measured, 0.036. One lobe: 0.54.
static void lobes_reflect_as_their_facets(void **state) {
    double errors[2];
    for (int i = 0; i < 2; i++) {
        wu_kind asked = kind;
        asked.lobes = i == 0 ? 6 : 1;
        model_run model;
        begin_light(&model, *state, 32, waves, &asked);
        const struct wu_level *last = &model.build.models.constants.levels[2];
        const struct wu_cell *cells = data_of(&model, model.build.models.cells,
                                              (last->first_cell + 1) * sizeof(struct wu_cell));
        errors[i] = error_of_lobes(cells, asked.lobes);
        end(&model);
    }
    if (!(errors[0] <= 0.044 && errors[1] > 3 * errors[0]))
        fail_msg("six lobes: %.4f, one: %.4f", errors[0], errors[1]);
}

static double sum_of_cosines(void) {
    double sum = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        const double radius = fmax(abs(i % 9 - 4), abs(i / 9 - 4)) * 2 / 9;
        sum += 1 - radius * radius;
    }
    return sum;
}

/// A white relief reflects all light: all paths together the cosine to the viewer.
static void paths_lose_no_light(void **state) {
    model_run model;
    begin_light(&model, *state, 32, waves, &kind);
    const size_t bytes = PATCHES * PAIRS * sizeof(float);
    const float *direct = data_of(&model, model.build.direct, bytes),
                *indirect = data_of(&model, model.build.indirect, bytes);
    double sum = 0, at_once = 0;
    for (uint32_t i = 0; i < PAIRS; i++) {
        sum += light_between(direct, indirect, i / DIRECTIONS, i % DIRECTIONS);
        at_once += (double)direct[i];
    }
    // The directions are few: a level map's light is more than 1 as well.
    sum *= M_PI / pow(sum_of_cosines(), 2);
    at_once *= M_PI / pow(sum_of_cosines(), 2);
    // The noise of 1024 paths.
    if (!(fabs(sum - 1) < 0.02 && at_once < 0.7))
        fail_msg("reflected: %g, at once %g", sum, at_once);
    end(&model);
}

static void tables_are_the_same_both_ways(void **state) {
    for (int printed = 0; printed < 2; printed++) {
        wu_kind asked = kind;
        asked.printed = printed == 1;
        model_run model;
        begin_light(&model, *state, 32, waves, &asked);
        const wu_models *models = &model.build.models;
        const uint32_t levels = models->constants.level_count;
        const float *ratios = data_of(&model, models->ratios, levels * PAIRS * 2 * sizeof(float));
        double off_one = 0;
        for (uint32_t i = 0; i < PAIRS; i++) {
            const uint32_t other = i % DIRECTIONS * DIRECTIONS + i / DIRECTIONS;
            assert_true(ratios[2 * i] == ratios[2 * other]);
            assert_true(ratios[2 * i + 1] == ratios[2 * other + 1]);
            assert_true(ratios[2 * i] >= 0 && ratios[2 * i] <= 4);
            off_one += fabs((double)ratios[2 * i] - 1) / PAIRS;
        }
        assert_true(off_one > 0.05);
        end(&model);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coarse_heights_are_the_closed_form),
        cmocka_unit_test(a_level_map_is_not_scaled),
        cmocka_unit_test(patches_have_no_borders),
        cmocka_unit_test(valleys_reflect_their_closed_form),
        cmocka_unit_test(lobes_reflect_as_their_facets),
        cmocka_unit_test(paths_lose_no_light),
        cmocka_unit_test(tables_are_the_same_both_ways),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
