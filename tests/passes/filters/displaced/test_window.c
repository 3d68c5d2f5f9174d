// Reliefs with more facets than a buffer holds, made window by window: windows cover the map, and
// what they make is what one window makes, bit for bit.

#include <stdlib.h>

#include "tests/passes/filters/displaced/relief_windows.h"

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

enum { WINDOWS = 16, FEW = WINDOWS_FACETS(22) };

static transfer_map declare(const relief_windows *run, uint32_t parts, bool in_parts) {
    const relief relief = passes_relief(&run->run.context, 0, in_parts);
    transfer_map map = passes_transfer_declare(&run->run.context, 0, &run->kind);
    passes_transfer_map(&(transfer_request){.context = &run->run.context,
                                            .kind = &run->kind,
                                            .relief = &relief,
                                            .parts = parts,
                                            .in_parts = in_parts},
                        &map);
    return map;
}

/// The work of all windows.
static uint32_t count_parts(const relief_windows *run) {
    const device_material *material = &run->run.context.scene->materials[0];
    const window_grid grid = passes_transfer_grid(material, &run->kind);
    uint32_t parts = 0;
    for (uint32_t i = 0; i < grid.columns * grid.rows; i++)
        parts += passes_transfer_tile(material, &run->kind, i).parts;
    return parts;
}

/// At once, and part by part, each of which runs once.
static void check_windows(fixture *f, bool coloured) {
    relief_windows whole, windowed;
    relief_windows_begin(&whole, f, coloured, 0);
    const transfer_map expected = declare(&whole, UINT32_MAX, false);
    const size_t count = relief_windows_count(&expected);
    float *numbers = relief_windows_read(&whole, &expected);
    relief_windows_end(&whole);
    for (int in_parts = 0; in_parts < 2; in_parts++) {
        relief_windows_begin(&windowed, f, coloured, FEW);
        const uint32_t parts = count_parts(&windowed);
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
        float *found = relief_windows_read(&windowed, &map);
        transfers += count_passes(graph, "facet_transfer", LOBE_PASS_RUN);
        cells += count_passes(graph, "cell_transfer", LOBE_PASS_RUN);
        assert_int_equal(transfers, WINDOWS);
        assert_int_equal(cells, (coloured ? 3 : 1) * WINDOWS);
        assert_memory_equal(found, numbers, count * sizeof *found);
        free(found);
        relief_windows_end(&windowed);
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
