// Reliefs with more facets than a buffer holds, made window by window: windows cover the map, and
// what they make is what one window makes, bit for bit.

#include <math.h>
#include <stdlib.h>

#include "passes/filters/displaced/transfer_map.h"
#include "passes/upload/device_scene_parts.h"
#include "tests/passes/filters/displaced/relief_plane.h"
#include "tests/passes/support/pass_run.h"

static uint32_t half(uint32_t extent) {
    return extent > 1 ? extent / 2 : 1;
}

/// Each texel of the map belongs to one window, which has the quads under it, and those around.
static void windows_cover_the_map(void **state) {
    static const struct {
        uint32_t width, height;
        uint64_t facets;
    } maps[] = {{1024, 1024, 4194240}, {4096, 4096, 4194240}, {2049, 1823, 4194240},
                {8192, 2048, 4194240}, {3001, 17, 40000},     {4096, 1, 1000}};
    (void)state;
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        const device_map map = {.width = maps[i].width, .height = maps[i].height};
        const window_grid grid = passes_window_grid(&map, maps[i].facets);
        uint32_t texels = 0;
        assert_int_equal(grid.columns * grid.rows == 1, i == 0);
        for (uint32_t k = 0; k < grid.columns * grid.rows; k++) {
            const facet_window window = passes_window(&grid, k);
            assert_true(passes_window_facets(&window) <= maps[i].facets);
            assert_true(window.columns > 0 && window.rows > 0);
            assert_true(window.first_column + window.columns <= half(map.width));
            assert_true(window.first_row + window.rows <= half(map.height));
            assert_true(window.width == map.width ||
                        (2 * window.first_column + map.width - window.x) % map.width ==
                            WINDOW_MARGIN);
            assert_true(window.width == map.width ||
                        2 * window.columns + 2 * WINDOW_MARGIN <= window.width);
            assert_true(window.first_column % 8 == 0 && window.first_row % 8 == 0);
            texels += window.columns * window.rows;
        }
        assert_int_equal(texels, half(map.width) * half(map.height));
    }
}

enum { WIDTH = 512, HEIGHT = 16, FEW = 2 * (2 * WINDOW_MARGIN + 44) * HEIGHT, WINDOWS = 16 };

/// Nothing is seen from far away.
static double rough(uint32_t column, uint32_t row) {
    const uint32_t mixed = (column * 7919 + row * 104729 + 1) * 2654435761u;
    return 4 * (double)(mixed >> 8) / (1 << 24) + 2 * sin(2 * M_PI * column / 16);
}

typedef struct window_run {
    pass_run run;
    lobe_scene *scene;
    transfer_kind kind;
} window_run;

static void begin(window_run *run, fixture *f, bool coloured, uint64_t most_facets) {
    const lobe_material material = relief_material(1);
    run->kind = (transfer_kind){.order = 6,
                                .azimuths = 4,
                                .bounces = 8,
                                .format = LOBE_FORMAT_RGBA32_FLOAT,
                                .coloured = coloured,
                                .most_facets = most_facets};
    run->scene = relief_plane(&material, relief_map(WIDTH, HEIGHT, rough), (double[]){0, 0, 1}, 1);
    scene_end(run->scene);
    pass_run_begin(&run->run, f, run->scene, "displaced", (const char *const[]){NULL});
    assert_int_equal(passes_device_scene_upload_heights(run->run.scene, &f->host), LOBE_OK);
    lobe_graph_invalidate(run->run.context.graph);
}

static void end(window_run *run) {
    pass_run_end(&run->run);
    lobe_scene_destroy(&run->scene);
}

static transfer_map declare(const window_run *run, uint32_t parts, bool in_parts) {
    const relief relief = passes_relief(&run->run.context, 0, in_parts);
    return passes_transfer_map(&run->run.context, 0, &run->kind, &relief, NULL, parts, in_parts);
}

static size_t count_numbers(const transfer_map *map) {
    return passes_reduced_map_bytes(&map->map, LOBE_FORMAT_RGBA32_FLOAT) / sizeof(float);
}

/// At once, and part by part, each of which runs once.
static void check_windows(fixture *f, bool coloured) {
    window_run whole, windowed;
    begin(&whole, f, coloured, 0);
    const transfer_map expected = declare(&whole, UINT32_MAX, false);
    const size_t count = count_numbers(&expected);
    float *numbers = pass_run_read(&whole.run, &expected.map, whole.kind.format);
    end(&whole);
    for (int in_parts = 0; in_parts < 2; in_parts++) {
        begin(&windowed, f, coloured, FEW);
        const device_material *material = &windowed.run.context.scene->materials[0];
        const uint32_t parts = passes_transfer_part_count(material, &windowed.kind);
        lobe_graph *graph = windowed.run.context.graph;
        size_t transfers = 0, cells = 0;
        assert_int_equal(parts, 3 * WINDOWS);
        for (uint32_t part = 1; in_parts && part < parts; part++) {
            (void)declare(&windowed, part, true);
            pass_run_execute(&windowed.run);
            transfers += count_passes(graph, "facet_transfer", LOBE_PASS_RUN);
            cells += count_passes(graph, "cell_transfer", LOBE_PASS_RUN);
            lobe_graph_begin(graph);
        }
        const transfer_map map = declare(&windowed, parts, in_parts);
        float *found = pass_run_read(&windowed.run, &map.map, windowed.kind.format);
        transfers += count_passes(graph, "facet_transfer", LOBE_PASS_RUN);
        cells += count_passes(graph, "cell_transfer", LOBE_PASS_RUN);
        assert_int_equal(transfers, WINDOWS);
        assert_int_equal(cells, (coloured ? 3 : 1) * WINDOWS);
        assert_memory_equal(found, numbers, count * sizeof *found);
        free(found);
        end(&windowed);
    }
    free(numbers);
}

static void windows_make_the_same_map(void **state) {
    check_windows(*state, false);
}

/// Each colour has layers of its own.
static void windows_make_the_same_colours(void **state) {
    check_windows(*state, true);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_cover_the_map),
        cmocka_unit_test(windows_make_the_same_map),
        cmocka_unit_test(windows_make_the_same_colours),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
