// What `wu` and `displaced` show of single cells of 16 x 16 texels of a relief, against paths of
// light followed here, over 48 x 48 directions of light and viewer that neither's tables have. The
// filters are evaluated in a shader of a host.
//
// `test_filters_wu_cell_error maps` prints the errors of three maps made here, `... FILE...` those
// of height maps in files.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/maps.h>

#include "cell_radiance_displaced.h"
#include "cell_radiance_wu.h"
#include "tests/passes/filters/displaced/relief_plane.h"
#include "tests/passes/filters/wu/relief_truth.h"
#include "tests/passes/filters/wu/sample_reliefs.h"
#include "tests/passes/own_shading/host_evaluation.h"

enum { CELL = 16, PAIRS = TRUTH_DIRECTIONS * TRUTH_DIRECTIONS };

static const double albedo = 0.8;

/// As cell_radiance.comp.
typedef struct cell_data {
    float directions[TRUTH_DIRECTIONS][4];
    uint32_t cells[4];
    float radiance[];
} cell_data;

static cell_data *allocate_data(const lobe_image *map, uint32_t cells, size_t *size) {
    double directions[TRUTH_DIRECTIONS][3];
    relief_truth_directions(directions);
    *size = sizeof(cell_data) + (size_t)cells * PAIRS * sizeof(float);
    cell_data *data = calloc(1, *size);
    assert_non_null(data);
    for (int i = 0; i < TRUTH_DIRECTIONS; i++)
        for (int k = 0; k < 3; k++) // the tangent frame's y runs against the relief's
            data->directions[i][k] = (float)(k == 1 ? -directions[i][k] : directions[i][k]);
    const uint32_t numbers[4] = {map->width / CELL, map->height / CELL, map->width, map->height};
    memcpy(data->cells, numbers, sizeof numbers);
    return data;
}

static lobe_scene *scene_of(const lobe_image *map) {
    lobe_image copy = map_image(LOBE_FORMAT_RGBA32_FLOAT, map->width, map->height);
    for (size_t i = 0; i < 4 * (size_t)map->width * map->height; i += 4)
        ((float *)copy.texels)[i] = relief_map_value((double)((const float *)map->texels)[i]);
    const lobe_material material = relief_material(albedo);
    lobe_scene *scene = relief_plane(&material, copy, (const double[]){0, 0, 1}, 1);
    scene_end(scene);
    return scene;
}

/// A filter with settings, ended by NULL.
typedef struct candidate {
    const char *filter;
    const char *settings[4];
} candidate;

/// By cell, light and viewer. Free with free().
static cell_data *radiance_of(const lobe_image *map, uint32_t cells, const candidate *c) {
    const bool is_wu = strcmp(c->filter, "wu") == 0;
    const host_shader shader = {is_wu ? cell_radiance_wu : cell_radiance_displaced,
                                is_wu ? sizeof cell_radiance_wu : sizeof cell_radiance_displaced, 7,
                                (cells * TRUTH_DIRECTIONS + 63) / 64};
    const char *assignments[8] = {"bias=0"};
    for (int i = 0; c->settings[i]; i++)
        assignments[1 + i] = c->settings[i];
    const lobe_settings settings = settings_of(filter_named(c->filter), assignments);
    host_device host;
    host_evaluation evaluation = {0};
    host_device_open(&host);
    lobe_device *device = host_device_import(&host);
    lobe_scene *scene = scene_of(map);
    lobe_maps *maps;
    assert_int_equal(lobe_maps_create(device,
                                      &(lobe_maps_parameters){.scene = scene,
                                                              .filter = filter_named(c->filter),
                                                              .settings = &settings,
                                                              .lights_at_once = 4},
                                      &host.recorder.host, &maps),
                     LOBE_OK);
    size_t size;
    cell_data *data = allocate_data(map, cells, &size);
    host_evaluation_run(&evaluation, &host, maps, &shader, data, size);
    host_evaluation_end(&evaluation);
    lobe_maps_destroy(&maps);
    lobe_scene_destroy(&scene);
    lobe_device_destroy(&device);
    host_device_close(&host);
    return data;
}

typedef struct cell_error {
    double cells; ///< of single cells
    double map;   ///< of their mean
} cell_error;

/// The mean difference of radiance over the picture of each viewer, relative to the mean radiance:
/// a cell counts by the area of it that is seen.
static cell_error error_of(const relief_truth *truth, const cell_data *data) {
    double error = 0, total = 0, error_of_map = 0;
    for (uint32_t pair = 0; pair < PAIRS; pair++) {
        double directions[TRUTH_DIRECTIONS][3];
        relief_truth_directions(directions);
        const double cosine = directions[pair % TRUTH_DIRECTIONS][2];
        double difference = 0;
        for (uint32_t cell = 0; cell < truth->cells; cell++) {
            const size_t at = (size_t)cell * PAIRS + pair;
            const double expected = 0.5 * (truth->light[0][at] + truth->light[1][at]);
            const double found = (double)data->radiance[at] *
                                 truth->visible[cell * TRUTH_DIRECTIONS + pair % TRUTH_DIRECTIONS];
            error += fabs(found - expected) / cosine;
            total += expected / cosine;
            difference += (found - expected) / cosine;
        }
        error_of_map += fabs(difference);
    }
    return (cell_error){error / total, error_of_map / total};
}

/// The truth's own error: half the difference of its halves.
static cell_error floor_of(const relief_truth *truth) {
    double error = 0, total = 0, error_of_map = 0;
    double directions[TRUTH_DIRECTIONS][3];
    relief_truth_directions(directions);
    for (uint32_t pair = 0; pair < PAIRS; pair++) {
        const double cosine = directions[pair % TRUTH_DIRECTIONS][2];
        double difference = 0;
        for (uint32_t cell = 0; cell < truth->cells; cell++) {
            const size_t at = (size_t)cell * PAIRS + pair;
            error += 0.5 * fabs(truth->light[0][at] - truth->light[1][at]) / cosine;
            total += 0.5 * (truth->light[0][at] + truth->light[1][at]) / cosine;
            difference += 0.5 * (truth->light[0][at] - truth->light[1][at]) / cosine;
        }
        error_of_map += fabs(difference);
    }
    return (cell_error){error / total, error_of_map / total};
}

static cell_error measure(const lobe_image *map, const relief_truth *truth, const candidate *c) {
    cell_data *data = radiance_of(map, truth->cells, c);
    const cell_error error = error_of(truth, data);
    free(data);
    return error;
}

// ---------------------------------------------------------------------------------------------
// Tables

static void print_line(const char *filter, const char *setting, cell_error error) {
    printf("    %-10s %-24s %6.3f %6.3f\n", filter, setting, error.cells, error.map);
    fflush(stdout);
}

/// `displaced` with each number of functions that it has.
static void print_displaced(const lobe_image *map, const relief_truth *truth) {
    const lobe_filter *filter = filter_named("displaced");
    for (size_t k = 0; k < lobe_filter_knob_count(filter); k++) {
        const lobe_knob *knob = lobe_filter_knob(filter, k);
        if (strcmp(knob->name, "order") != 0)
            continue;
        for (size_t i = 0; knob->choices[i]; i++) {
            char order[64];
            snprintf(order, sizeof order, "order=%s", knob->choices[i]);
            print_line("displaced", order,
                       measure(map, truth, &(candidate){"displaced", {order, NULL}}));
        }
    }
}

static void print_map(const char *name, const lobe_image *map) {
    relief_truth truth = relief_truth_of(map, CELL, albedo, 32, 512);
    printf("%s: slopes %.2f\n", name, sample_relief_slope(map));
    print_line("floor", "", floor_of(&truth));
    print_line(
        "wu", "formulas=printed",
        measure(map, &truth, &(candidate){"wu", {"ratio=printed", "formulas=printed", NULL}}));
    print_line("wu", "ratio=printed",
               measure(map, &truth, &(candidate){"wu", {"ratio=printed", NULL}}));
    print_line("wu", "", measure(map, &truth, &(candidate){"wu", {NULL}}));
    print_displaced(map, &truth);
    relief_truth_free(&truth);
}

static void print_made(const char *name, lobe_image map) {
    print_map(name, &map);
    lobe_image_free(&map);
}

static void print_file(const fixture *f, const char *path) {
    lobe_image map = sample_relief_load(path, &f->host);
    print_map(path, &map);
    lobe_image_free(&map);
}

// ---------------------------------------------------------------------------------------------
// Tests

/// Noise of 64 x 64 texels.
static void cells_are_close_to_paths(void **state) {
    (void)state;
    lobe_image map = sample_relief_noise(64, 13, 71);
    relief_truth truth = relief_truth_of(&map, CELL, albedo, 32, 128);
    const cell_error own = floor_of(&truth),
                     displaced = measure(&map, &truth, &(candidate){"displaced", {NULL}}),
                     wu = measure(&map, &truth,
                                  &(candidate){"wu", {"points=1024", "angular=11", NULL}});
    print_message("# floor %.4f, displaced %.4f, wu %.4f\n", own.cells, displaced.cells, wu.cells);
    relief_truth_free(&truth);
    lobe_image_free(&map);
    // Measured: 0.0295, 0.0411, 0.0978.
    assert_true(own.cells <= 0.036 && displaced.cells <= 0.05 && wu.cells <= 0.12);
    assert_true(displaced.cells <= 0.6 * wu.cells);
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_close_to_paths),
    };
    if (count < 2)
        return cmocka_run_group_tests(tests, NULL, NULL);
    void *state = NULL;
    fixture_create(&state);
    for (int i = 1; i < count; i++) {
        if (strcmp(arguments[i], "maps") != 0) {
            print_file(state, arguments[i]);
            continue;
        }
        print_made("twill", sample_relief_twill());
        print_made("bumps", sample_relief_bumps(90125));
        print_made("noise", sample_relief_noise(SAMPLE_EXTENT, 15, 5150));
    }
    fixture_destroy(&state);
    return 0;
}
