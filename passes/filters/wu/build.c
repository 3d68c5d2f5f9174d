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

static lobe_resource retained(lobe_graph *graph, const char *what, uint32_t material,
                              uint64_t bytes) {
    char name[64];
    snprintf(name, sizeof name, "%s of material %u", what, material);
    return lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name, .size = (size_t)bytes, .retained = true});
}

lobe_resource passes_wu_shared_buffer(const wu_build *build, const char *name, uint64_t bytes) {
    return build->in_parts ? retained(build->graph, name, build->material, bytes)
                           : passes_wu_buffer(build, name, bytes);
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

/// Four floats, and those of mirrors, if there are any.
static uint64_t whole_bytes(const struct wu_constants *constants, bool mirrors) {
    const uint64_t directions = constants->angular * constants->angular,
                   patches = (uint64_t)constants->patches * constants->patches,
                   numbers = constants->level_count * (directions * directions + 2 * patches);
    return (4 + (mirrors ? numbers : 0)) * sizeof(float);
}

void passes_wu_model_bytes(const device_map *heights, const wu_kind *kind, uint32_t bytes[3]) {
    const struct wu_constants constants = constants_of(heights->width, heights->height, kind);
    const struct wu_level *last = &constants.levels[constants.level_count - 1];
    const uint32_t cells = last->first_cell + last->width * last->height,
                   directions = constants.angular * constants.angular;
    bytes[0] = cells * (uint32_t)sizeof(struct wu_cell);
    bytes[1] = (last->first_pair + directions * directions) * 2 * (uint32_t)sizeof(float);
    bytes[2] = (uint32_t)whole_bytes(&constants, kind->mirrors);
}

wu_models passes_wu_models_declare(const filter_context *context, uint32_t index,
                                   const wu_kind *kind) {
    const device_map *heights = &context->scene->materials[index].maps[MAP_HEIGHT];
    wu_models models = {.constants = constants_of(heights->width, heights->height, kind)};
    uint32_t bytes[3];
    passes_wu_model_bytes(heights, kind, bytes);
    models.block = lobe_graph_upload(context->graph, "models of a relief", &models.constants,
                                     sizeof models.constants);
    models.cells = retained(context->graph, "cells", index, bytes[0]);
    models.ratios = retained(context->graph, "scaling", index, bytes[1]);
    models.whole = retained(context->graph, "numbers of the whole map", index, bytes[2]);
    models.bytes = (uint64_t)bytes[0] + bytes[1] + bytes[2];
    return models;
}

wu_build passes_wu_begin(const filter_context *context, uint32_t index, const wu_kind *kind,
                         bool in_parts) {
    return (wu_build){.graph = context->graph,
                      .material = index,
                      .in_parts = in_parts,
                      .relief = passes_relief(context, index, in_parts),
                      .models = passes_wu_models_declare(context, index, kind),
                      .lobes = {SPECIALISE_WU_LOBES, kind->lobes}};
}
