#include "passes/filters/wu/build.h"

static uint32_t cell_count(const struct wu_level *level) {
    return level->width * level->height;
}

static relief declare_low(const wu_build *build, const struct wu_level *level) {
    relief low = {.constants = {.width = level->width,
                                .height = level->height,
                                .scale = 1,
                                .least_value = -HEIGHT_MAXIMUM,
                                .largest_value = HEIGHT_MAXIMUM,
                                .levels = {{.width = level->width, .height = level->height}}}};
    low.block = lobe_graph_upload(build->graph, "coarse height field", &low.constants,
                                  sizeof low.constants);
    low.heights =
        lobe_graph_image(build->graph, &(lobe_image_description){.name = "coarse heights",
                                                                 .format = LOBE_FORMAT_R32_FLOAT,
                                                                 .width = level->width,
                                                                 .height = level->height});
    low.maxima = low.block; // of no level
    low.extent = passes_wu_buffer(build, "extent of coarse heights", 4 * sizeof(float));
    return low;
}

/// Where the search for heights starts, and the slopes that it looks for.
typedef struct low_start {
    lobe_resource heights, slopes;
} low_start;

static low_start add_start(const wu_build *build, uint32_t index) {
    const struct wu_level *level = &build->models.constants.levels[index];
    const uint64_t bytes = cell_count(level) * sizeof(float);
    lobe_pass *pass = passes_wu_pass(build, "low_start");
    passes_relief_read(&build->relief, pass);
    low_start start;
    start.heights = lobe_pass_write(
        pass, &(lobe_binding){.name = "low_block",
                              .resource = passes_wu_buffer(build, "sought heights", bytes)});
    start.slopes = lobe_pass_write(
        pass, &(lobe_binding){.name = "slope_block",
                              .resource = passes_wu_buffer(build, "mean slopes", 2 * bytes)});
    passes_wu_dispatch(build, pass, "filters/wu/low_start.comp",
                       (uint32_t[]){level->width, level->height},
                       &(struct wu_step){.level = index});
    return start;
}

relief passes_wu_add_low_relief(const wu_build *build, uint32_t index) {
    const struct wu_level *level = &build->models.constants.levels[index];
    const uint64_t bytes = 4 * cell_count(level) * sizeof(float);
    relief low = declare_low(build, level);
    const low_start start = add_start(build, index);
    lobe_pass *pass = passes_wu_pass(build, "low_heights");
    lobe_pass_read(pass, &(lobe_binding){.name = "slope_block", .resource = start.slopes});
    lobe_pass_modify(pass, &(lobe_binding){.name = "low_block", .resource = start.heights});
    lobe_pass_write(pass, &(lobe_binding){.name = "search_block",
                                          .resource = passes_wu_buffer(build, "search", bytes)});
    lobe_pass_write(pass, &(lobe_binding){.name = "product_block",
                                          .resource = passes_wu_buffer(build, "products", bytes)});
    low.heights =
        lobe_pass_write(pass, &(lobe_binding){.name = "low_map", .resource = low.heights});
    low.extent =
        lobe_pass_write(pass, &(lobe_binding){.name = "low_extent_block", .resource = low.extent});
    passes_wu_dispatch(build, pass, "filters/wu/low_heights.comp", (uint32_t[]){1, 1},
                       &(struct wu_step){.level = index});
    return low;
}

/// Adds a pass with a thread for each cell, which it writes; the first pass of all writes first.
static void add_cell_pass(wu_build *build, uint32_t index, const char *name, const char *shader,
                          const relief *read, bool is_first) {
    lobe_pass *pass = passes_wu_pass(build, name);
    passes_relief_read(read, pass);
    const lobe_binding cells = {.name = "cell_block", .resource = build->models.cells};
    build->models.cells = is_first ? lobe_pass_write(pass, &cells) : lobe_pass_modify(pass, &cells);
    passes_wu_dispatch(build, pass, shader,
                       (uint32_t[]){cell_count(&build->models.constants.levels[index]), 1},
                       &(struct wu_step){.level = index});
}

void passes_wu_add_cells(wu_build *build, uint32_t index, const relief *low) {
    add_cell_pass(build, index, "low_lobes", "filters/wu/low_lobes.comp", &build->relief,
                  index == 0);
    add_cell_pass(build, index, "low_horizons", "filters/wu/low_horizons.comp", low, false);
}
