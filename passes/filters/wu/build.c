#include "passes/filters/wu/build.h"

#include <math.h>
#include <stdio.h>

lobe_pass *passes_wu_pass(const wu_build *build, const char *name) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass, &(lobe_binding){.name = "wu_block", .resource = build->models.block});
    return pass;
}

void passes_wu_dispatch(const wu_build *build, lobe_pass *pass, const char *shader,
                        const uint32_t threads[2], const struct wu_step *step) {
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = shader,
                                              .threads = {threads[0], threads[1]},
                                              .constants = step,
                                              .constants_size = sizeof *step,
                                              .specialisation = &build->lobes,
                                              .specialisation_count = 1});
}

lobe_resource passes_wu_buffer(const wu_build *build, const char *name, uint64_t bytes) {
    return lobe_graph_buffer(build->graph,
                             &(lobe_buffer_description){.name = name, .size = (size_t)bytes});
}

uint32_t passes_wu_path_count(const wu_build *build) {
    const struct wu_constants *constants = &build->models.constants;
    return constants->patches * constants->patches * constants->points;
}

static uint32_t cells_along(uint32_t texels, uint32_t spacing) {
    return texels < spacing ? 1 : texels / spacing;
}

void passes_wu_place_levels(uint32_t width, uint32_t height, const wu_kind *kind,
                            struct wu_constants *constants) {
    const uint32_t pairs = kind->angular * kind->angular * kind->angular * kind->angular;
    uint32_t cells = 0, level = 0;
    for (uint32_t spacing = 8; level < WU_LEVELS; spacing *= spacing == 8 ? 2 : 4) {
        const uint32_t columns = cells_along(width, spacing), rows = cells_along(height, spacing);
        const float x = (float)width / (float)columns, y = (float)height / (float)rows;
        constants->levels[level] = (struct wu_level){
            .first_cell = cells,
            .width = columns,
            .height = rows,
            .first_pair = level * pairs,
            .spacing_x = x,
            .spacing_y = y,
            .unit = sqrtf(x * y),
            .octave = log2f(fmaxf(x, y)),
        };
        cells += columns * rows;
        level++;
        if (columns == 1 && rows == 1)
            break;
    }
    constants->level_count = level;
}

static struct wu_constants constants_of(uint32_t width, uint32_t height, const wu_kind *kind) {
    const uint32_t patches = kind->patches * kind->patches;
    struct wu_constants constants = {.width = width,
                                     .height = height,
                                     .angular = kind->angular,
                                     .patches = kind->patches,
                                     .points = (kind->points + patches - 1) / patches,
                                     .bounces = kind->bounces,
                                     .printed = kind->printed};
    passes_wu_place_levels(width, height, kind, &constants);
    return constants;
}

static lobe_resource retained(const wu_build *build, const char *what, uint32_t material,
                              uint64_t bytes) {
    char name[64];
    snprintf(name, sizeof name, "%s of material %u", what, material);
    return lobe_graph_buffer(
        build->graph,
        &(lobe_buffer_description){.name = name, .size = (size_t)bytes, .retained = true});
}

/// Four floats, and those of mirrors, if there are any.
static uint64_t whole_bytes(const wu_build *build, uint64_t directions, bool mirrors) {
    const struct wu_constants *constants = &build->models.constants;
    const uint64_t patches = (uint64_t)constants->patches * constants->patches,
                   numbers = constants->level_count * (directions * directions + 2 * patches);
    return (4 + (mirrors ? numbers : 0)) * sizeof(float);
}

static void declare(wu_build *build, uint32_t material, const wu_kind *kind) {
    wu_models *models = &build->models;
    const struct wu_level *last = &models->constants.levels[models->constants.level_count - 1];
    const uint64_t cells = last->first_cell + (uint64_t)last->width * last->height;
    const uint64_t directions = models->constants.angular * models->constants.angular;
    const uint64_t cell_bytes = cells * sizeof(struct wu_cell),
                   ratio_bytes = (last->first_pair + directions * directions) * 2 * sizeof(float),
                   last_bytes = whole_bytes(build, directions, kind->mirrors);
    models->block = lobe_graph_upload(build->graph, "models of a relief", &models->constants,
                                      sizeof models->constants);
    models->cells = retained(build, "cells", material, cell_bytes);
    models->ratios = retained(build, "scaling", material, ratio_bytes);
    models->whole = retained(build, "numbers of the whole map", material, last_bytes);
    models->bytes = cell_bytes + ratio_bytes + last_bytes;
}

wu_build passes_wu_begin(const filter_context *context, uint32_t index, const wu_kind *kind) {
    const device_map *map = &context->scene->materials[index].maps[MAP_HEIGHT];
    wu_build build = {.graph = context->graph,
                      .relief = passes_relief(context, index, false),
                      .models = {.constants = constants_of(map->width, map->height, kind)},
                      .lobes = {SPECIALISE_WU_LOBES, kind->lobes}};
    declare(&build, index, kind);
    return build;
}
