#include "tests/passes/filters/displaced/relief_windows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/upload/device_scene_parts.h"
#include "tests/passes/filters/displaced/relief_plane.h"

static double rough(uint32_t column, uint32_t row) {
    const uint32_t mixed = (column * 7919 + row * 104729 + 1) * 2654435761u;
    return 4 * (double)(mixed >> 8) / (1 << 24) + 2 * sin(2 * M_PI * column / 16);
}

void relief_windows_begin(relief_windows *windows, fixture *f, bool coloured,
                          uint64_t most_facets) {
    const lobe_material material = relief_material(1);
    windows->kind = (transfer_kind){.order = 6,
                                    .azimuths = 4,
                                    .bounces = 8,
                                    .format = LOBE_FORMAT_RGBA32_FLOAT,
                                    .normals = true,
                                    .coloured = coloured,
                                    .most_facets = most_facets};
    windows->scene = relief_plane(&material, relief_map(WINDOWS_WIDTH, WINDOWS_HEIGHT, rough),
                                  (double[]){0, 0, 1}, 1);
    scene_end(windows->scene);
    pass_run_begin(&windows->run, f, windows->scene, "displaced", (const char *const[]){NULL});
    assert_int_equal(passes_device_scene_upload_heights(windows->run.scene, &f->host), LOBE_OK);
    lobe_graph_invalidate(windows->run.context.graph);
}

void relief_windows_end(relief_windows *windows) {
    pass_run_end(&windows->run);
    lobe_scene_destroy(&windows->scene);
}

static size_t count_numbers(const reduced_map *map) {
    return passes_reduced_map_bytes(map, LOBE_FORMAT_RGBA32_FLOAT) / sizeof(float);
}

size_t relief_windows_count(const transfer_map *map) {
    return count_numbers(&map->map) + count_numbers(&map->facets);
}

float *relief_windows_read(relief_windows *windows, const transfer_map *map) {
    lobe_graph *graph = windows->run.context.graph;
    lobe_graph_read_back(graph, map->map.resource, (lobe_range){0});
    lobe_graph_read_back(graph, map->facets.resource, (lobe_range){0});
    pass_run_execute(&windows->run);
    float *numbers = malloc(relief_windows_count(map) * sizeof *numbers);
    assert_non_null(numbers);
    const size_t first = count_numbers(&map->map) * sizeof *numbers;
    memcpy(numbers, lobe_graph_data(graph, map->map.resource, NULL), first);
    memcpy((char *)numbers + first, lobe_graph_data(graph, map->facets.resource, NULL),
           count_numbers(&map->facets) * sizeof *numbers);
    return numbers;
}
