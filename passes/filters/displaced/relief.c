#include "passes/filters/displaced/relief.h"

#include <stdio.h>

#include "passes/upload/material_maps.h"

bool passes_has_relief(const device_material *material) {
    return material->maps[MAP_HEIGHT].use && material->material->height_scale != 0;
}

/// Places the levels one after the other, from level 1 on; returns the number of their values.
static uint32_t place_levels(struct height_field_constants *constants) {
    uint32_t width = constants->width, height = constants->height, level = 0;
    uint32_t offset = 0u - width * height;
    for (;; level++) {
        constants->levels[level] =
            (struct height_level){.offset = offset, .width = width, .height = height};
        offset += width * height;
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

static void add_extent(lobe_graph *graph, relief *relief) {
    const uint32_t rows = relief->constants.height;
    lobe_resource sums =
        lobe_graph_buffer(graph, &(lobe_buffer_description){.name = "rows of heights",
                                                            .size = rows * 4 * sizeof(float)});
    lobe_pass *pass = add_pass(relief, graph, "height_rows");
    lobe_pass_read(pass, &(lobe_binding){.name = "height_map", .resource = relief->heights});
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
    lobe_pass_read(pass, &(lobe_binding){.name = "height_map", .resource = relief->heights});
    const lobe_binding maxima = {.name = "maxima_block", .resource = relief->maxima};
    relief->maxima = level == 1 ? lobe_pass_write(pass, &maxima) : lobe_pass_modify(pass, &maxima);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "filters/displaced/height_maxima.comp",
                                        .threads = {target->width, target->height},
                                        .specialisation = &(lobe_specialisation){.bits = level},
                                        .specialisation_count = 1});
}

static void declare(const filter_context *context, uint32_t index, bool retained, relief *relief) {
    char name[64];
    snprintf(name, sizeof name, "largest heights of material %u", index);
    relief->maxima = lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){
                            .name = name, .size = (size_t)relief->bytes, .retained = retained});
    snprintf(name, sizeof name, "extent of heights of material %u", index);
    relief->extent = lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){
                            .name = name, .size = HEIGHT_EXTENT_BYTES, .retained = retained});
    relief->block = lobe_graph_upload(context->graph, "height field", &relief->constants,
                                      sizeof relief->constants);
}

relief passes_relief(const filter_context *context, uint32_t index, bool retained) {
    const device_material *material = &context->scene->materials[index];
    const device_map *map = &material->maps[MAP_HEIGHT];
    relief relief = {.constants = {.width = map->width,
                                   .height = map->height,
                                   .scale = material->material->height_scale * (float)map->width,
                                   .largest_value = 1}};
    relief.bytes = place_levels(&relief.constants) * sizeof(float);
    relief.heights = passes_device_map_import(context->graph, context->scene, material, MAP_HEIGHT);
    declare(context, index, retained, &relief);
    add_extent(context->graph, &relief);
    for (uint32_t level = 1; level <= relief.constants.last_level; level++)
        add_maxima(context->graph, &relief, level);
    return relief;
}

/// Under the names that shaders have for them. Samplers repeat.
static void name_parts(const relief *relief, lobe_binding parts[4]) {
    parts[0] = (lobe_binding){.name = "height_field_block", .resource = relief->block};
    parts[1] = (lobe_binding){.name = "height_map", .resource = relief->heights};
    parts[2] = (lobe_binding){.name = "maxima_block", .resource = relief->maxima};
    parts[3] = (lobe_binding){.name = "height_extent_block", .resource = relief->extent};
}

void passes_relief_read(const relief *relief, lobe_pass *pass) {
    lobe_binding parts[4];
    name_parts(relief, parts);
    for (size_t i = 0; i < 4; i++)
        lobe_pass_read(pass, &parts[i]);
}

static relief no_relief(const filter_context *context) {
    static const struct height_field_constants none;
    const lobe_resource block = lobe_graph_upload(context->graph, "no relief", &none, sizeof none);
    return (relief){
        .block = block,
        .heights = lobe_graph_import_texture(context->graph, context->scene->white),
        .maxima = block,
        .extent = block,
    };
}

void passes_relief_bind(const relief *drawn, const filter_context *context,
                        filtered_appearance *appearance) {
    const relief bound = drawn ? *drawn : no_relief(context);
    lobe_binding parts[4];
    name_parts(&bound, parts);
    for (size_t i = 0; i < 4; i++)
        passes_appearance_bind(appearance, parts[i].name, parts[i].resource, (lobe_sampler){0});
}
