#include "passes/environment/reduction.h"

static void write_level(lobe_pass *pass, reduced_map *cube, const char *binding, uint32_t level) {
    cube->resource =
        lobe_pass_write(pass, &(lobe_binding){binding, cube->resource, .range = {level, 1, 0, 6}});
}

/// Fills one or three levels from `first` on; returns how many.
static uint32_t reduce_step(lobe_graph *graph, reduced_map *cube, uint32_t first) {
    uint32_t source_width = cube->width >> (first - 1);
    bool tiled = source_width >= 8;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_reduction");
    lobe_pass_read(pass, &(lobe_binding){"source", cube->resource, .range = {first - 1, 1, 0, 6}});
    if (tiled) {
        write_level(pass, cube, "target_1", first);
        write_level(pass, cube, "target_2", first + 1);
        write_level(pass, cube, "target_3", first + 2);
    } else {
        write_level(pass, cube, "target", first);
    }
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = tiled ? "environment/reduction_tiled.comp"
                                                 : "environment/reduction.comp",
                                 .threads = {source_width / 2, source_width / 2, 6},
                             });
    return tiled ? 3 : 1;
}

void passes_environment_reduction(lobe_graph *graph, reduced_map *cube) {
    for (uint32_t level = 1; level < cube->levels;)
        level += reduce_step(graph, cube, level);
}
