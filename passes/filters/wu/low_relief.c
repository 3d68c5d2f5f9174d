#include "passes/filters/wu/build.h"

static uint32_t cell_count(const struct wu_level *level) {
    return level->width * level->height;
}

static relief declare_low(const wu_build *build, const struct wu_level *level) {
    relief low = {.constants = {.width = level->width,
                                .height = level->height,
                                .levels = {{.width = level->width, .height = level->height}}}};
    low.block = lobe_graph_upload(build->graph, "coarse height field", &low.constants,
                                  sizeof low.constants);
    low.bytes = cell_count(level) * sizeof(float);
    low.heights = passes_wu_buffer(build, "coarse heights", low.bytes);
    low.extent = passes_wu_buffer(build, "extent of coarse heights", 4 * sizeof(float));
    return low;
}

static lobe_resource add_start(const wu_build *build, uint32_t index, relief *low) {
    const struct wu_level *level = &build->models.constants.levels[index];
    lobe_pass *pass = passes_wu_pass(build, "low_start");
    passes_relief_read(&build->relief, pass);
    low->heights =
        lobe_pass_write(pass, &(lobe_binding){.name = "low_block", .resource = low->heights});
    const lobe_resource slopes = lobe_pass_write(
        pass, &(lobe_binding){.name = "slope_block",
                              .resource = passes_wu_buffer(build, "mean slopes", 2 * low->bytes)});
    passes_wu_dispatch(build, pass, "filters/wu/low_start.comp",
                       (uint32_t[]){level->width, level->height},
                       &(struct wu_step){.level = index});
    return slopes;
}

relief passes_wu_add_low_relief(const wu_build *build, uint32_t index) {
    relief low = declare_low(build, &build->models.constants.levels[index]);
    const lobe_resource slopes = add_start(build, index, &low);
    lobe_pass *pass = passes_wu_pass(build, "low_heights");
    lobe_pass_read(pass, &(lobe_binding){.name = "slope_block", .resource = slopes});
    low.heights =
        lobe_pass_modify(pass, &(lobe_binding){.name = "low_block", .resource = low.heights});
    lobe_pass_write(pass,
                    &(lobe_binding){.name = "search_block",
                                    .resource = passes_wu_buffer(build, "search", 4 * low.bytes)});
    lobe_pass_write(
        pass, &(lobe_binding){.name = "product_block",
                              .resource = passes_wu_buffer(build, "products", 4 * low.bytes)});
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
