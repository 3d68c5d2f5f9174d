#include "passes/filters/displaced/relief.h"

#include <stdio.h>

#include "passes/upload/material_maps.h"

/// What Vulkan asks of every device: 128 MiB.
#define LARGEST_BUFFER ((uint64_t)1 << 27)

bool passes_has_relief(const device_material *material) {
    return material->maps[MAP_HEIGHT].use && material->material->height_scale != 0;
}

/// Places the levels one after the other; returns the number of their values.
static uint64_t place_levels(struct height_field_constants *constants) {
    uint32_t width = constants->width, height = constants->height, level = 0;
    uint64_t offset = 0;
    for (;; level++) {
        constants->levels[level] =
            (struct height_level){.offset = (uint32_t)offset, .width = width, .height = height};
        offset += (uint64_t)width * height;
        if ((level > 0 && width == 1 && height == 1) || level + 1 == HEIGHT_LEVELS)
            break;
        width = (width + 3) / 4;
        height = (height + 3) / 4;
    }
    constants->last_level = level;
    return offset;
}

static lobe_pass *add_pass(const relief *relief, lobe_graph *graph, const char *name) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass, &(lobe_binding){.name = "height_field_block", .resource = relief->block});
    return pass;
}

static void add_heights(const filter_context *context, const device_material *material,
                        relief *relief) {
    lobe_pass *pass = add_pass(relief, context->graph, "height_cells");
    lobe_pass_read(
        pass, &(lobe_binding){.name = "height_map",
                              .resource = passes_device_map_import(context->graph, context->scene,
                                                                   material, MAP_HEIGHT)});
    relief->heights =
        lobe_pass_write(pass, &(lobe_binding){.name = "height_block", .resource = relief->heights});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "filters/displaced/height_cells.comp",
                               .threads = {relief->constants.width, relief->constants.height}});
}

static void add_extent(lobe_graph *graph, relief *relief) {
    const uint32_t rows = relief->constants.height;
    lobe_resource sums =
        lobe_graph_buffer(graph, &(lobe_buffer_description){.name = "rows of heights",
                                                            .size = rows * 4 * sizeof(float)});
    lobe_pass *pass = add_pass(relief, graph, "height_rows");
    lobe_pass_read(pass, &(lobe_binding){.name = "height_block", .resource = relief->heights});
    sums = lobe_pass_write(pass, &(lobe_binding){.name = "row_block", .resource = sums});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "filters/displaced/height_rows.comp", .threads = {rows}});
    pass = add_pass(relief, graph, "height_extent");
    lobe_pass_read(pass, &(lobe_binding){.name = "row_block", .resource = sums});
    relief->extent = lobe_pass_write(
        pass, &(lobe_binding){.name = "height_extent_block", .resource = relief->extent});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/height_extent.comp"});
}

static void add_maxima(lobe_graph *graph, relief *relief, uint32_t level) {
    const struct height_level *target = &relief->constants.levels[level];
    lobe_pass *pass = add_pass(relief, graph, "height_maxima");
    relief->heights = lobe_pass_modify(
        pass, &(lobe_binding){.name = "height_block", .resource = relief->heights});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "filters/displaced/height_maxima.comp",
                                        .threads = {target->width, target->height},
                                        .specialisation = &(lobe_specialisation){.bits = level},
                                        .specialisation_count = 1});
}

static void declare(const filter_context *context, uint32_t index, uint64_t values, bool retained,
                    relief *relief) {
    char name[64];
    snprintf(name, sizeof name, "heights of material %u", index);
    relief->heights = lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){
                            .name = name, .size = values * sizeof(float), .retained = retained});
    snprintf(name, sizeof name, "extent of heights of material %u", index);
    relief->extent = lobe_graph_buffer(
        context->graph,
        &(lobe_buffer_description){.name = name, .size = 4 * sizeof(float), .retained = retained});
    relief->block = lobe_graph_upload(context->graph, "height field", &relief->constants,
                                      sizeof relief->constants);
}

relief passes_relief(const filter_context *context, uint32_t index, bool retained) {
    const device_material *material = &context->scene->materials[index];
    const device_map *map = &material->maps[MAP_HEIGHT];
    relief relief = {.constants = {.width = map->width,
                                   .height = map->height,
                                   .scale = material->material->height_scale * (float)map->width}};
    uint64_t values = place_levels(&relief.constants);
    relief.bytes = values * sizeof(float);
    if (relief.bytes > LARGEST_BUFFER) {
        lobe_graph_fail(context->graph, LOBE_ERROR_LIMIT,
                        "%s: a height map of %u x %u texels is too large for filter '%s'",
                        material->material->name, map->width, map->height,
                        lobe_filter_name(context->filter));
        values = 1;
    }
    declare(context, index, values, retained, &relief);
    add_heights(context, material, &relief);
    add_extent(context->graph, &relief);
    for (uint32_t level = 1; level <= relief.constants.last_level; level++)
        add_maxima(context->graph, &relief, level);
    return relief;
}

void passes_relief_read(const relief *relief, lobe_pass *pass) {
    lobe_pass_read(pass, &(lobe_binding){.name = "height_field_block", .resource = relief->block});
    lobe_pass_read(pass, &(lobe_binding){.name = "height_block", .resource = relief->heights});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "height_extent_block", .resource = relief->extent});
}

void passes_relief_bind(const relief *relief, lobe_graph *graph, filtered_appearance *appearance) {
    static const struct height_field_constants none;
    static const char *const names[] = {"height_field_block", "height_block",
                                        "height_extent_block"};
    lobe_resource bound[3];
    if (relief) {
        bound[0] = relief->block;
        bound[1] = relief->heights;
        bound[2] = relief->extent;
    } else
        bound[0] = bound[1] = bound[2] = lobe_graph_upload(graph, "no relief", &none, sizeof none);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        passes_appearance_bind(appearance, names[i], bound[i], (lobe_sampler){0});
}
