#include "passes/maps/seen_tiles.h"

#include <stddef.h>
#include <stdio.h>

#include "passes/upload/material_maps.h"
#include "shaders/interface/map_tiles.h"

static uint32_t extent_at(uint32_t size, uint32_t level) {
    return size >> level > 0 ? size >> level : 1;
}

static uint32_t tiles_of(uint32_t extent) {
    return (extent + MAP_TILE - 1) / MAP_TILE;
}

uint32_t passes_map_tile_levels(uint32_t width, uint32_t height, uint32_t first_mark,
                                struct tile_level levels[MAP_TILE_LEVELS]) {
    width = passes_half_extent(width);
    height = passes_half_extent(height);
    const uint32_t count = passes_level_count(width, height);
    for (uint32_t i = 0; i < count; i++) {
        levels[i] = (struct tile_level){.first_mark = first_mark,
                                        .columns = tiles_of(extent_at(width, i)),
                                        .width = extent_at(width, i),
                                        .height = extent_at(height, i)};
        first_mark += levels[i].columns * tiles_of(levels[i].height);
    }
    return count;
}

uint32_t passes_map_tile_count(uint32_t width, uint32_t height) {
    struct tile_level levels[MAP_TILE_LEVELS];
    const uint32_t count = passes_map_tile_levels(width, height, 0, levels);
    return levels[count - 1].first_mark + 1;
}

// ---------------------------------------------------------------------------------------------
// The list

/// A retained buffer, or one of this frame.
static lobe_resource declare_numbers(lobe_graph *graph, const char *name, uint32_t count,
                                     bool retained) {
    return lobe_graph_buffer(graph, &(lobe_buffer_description){.name = name,
                                                               .size = count * sizeof(uint32_t),
                                                               .retained = retained});
}

/// What tiles of a map are made of.
typedef struct tile_source {
    uint32_t width, height; ///< texels
    uint32_t first_mark;
    bool reduced;
    lobe_resource condition, made_with; ///< version 0: none
} tile_source;

static void list_tiles(const filter_context *context, const tile_source *source, const char *name,
                       reduced_map *map) {
    lobe_graph *graph = context->graph;
    const uint32_t count = passes_map_tile_count(source->width, source->height);
    char states_name[96], list_name[96];
    snprintf(states_name, sizeof states_name, "tiles of %s", name);
    snprintf(list_name, sizeof list_name, "tile list of %s", name);
    lobe_resource states = declare_numbers(graph, states_name, count, true);
    lobe_resource list =
        declare_numbers(graph, list_name, MAP_TILE_LEVELS * MAP_TILE_RECORD + 2 * count, false);
    map->keeps =
        lobe_graph_has_content(graph, states) && lobe_graph_has_content(graph, map->resource);
    const bool made_with = source->made_with.version > 0;
    const struct tile_list_constants constants = {
        .first_mark = source->first_mark,
        .width = map->width,
        .height = map->height,
        .levels = map->levels,
        .layers = map->layers,
        .forgets = !map->keeps || context->marks->rebuild,
        .reduced = source->reduced,
        .conditional = source->condition.version > 0,
        .made_with = made_with ? (uint32_t)(lobe_graph_buffer_size(graph, source->made_with) /
                                            sizeof(uint32_t))
                               : 0,
    };
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "tile_list");
    lobe_pass_read(pass, &(lobe_binding){.name = "mark_block", .resource = context->marks->marks});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "condition_block",
                                   .resource = constants.conditional ? source->condition
                                                                     : context->marks->marks});
    lobe_pass_read(
        pass, &(lobe_binding){.name = "made_with_block",
                              .resource = made_with ? source->made_with : context->marks->marks});
    const lobe_binding known = {.name = "state_block", .resource = states};
    (void)(map->keeps ? lobe_pass_modify(pass, &known) : lobe_pass_write(pass, &known));
    map->tiles =
        lobe_pass_write(pass, &(lobe_binding){.name = "tile_list_block", .resource = list});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "maps/tile_list.comp",
                               .threads = {1, 1, 1},
                               .constants = &constants,
                               .constants_size = sizeof constants,
                               .numbered = map->resource,
                               .number_offset = offsetof(struct tile_list_constants, content)});
}

static reduced_map declare_map(const filter_context *context, const char *name, lobe_format format,
                               uint32_t layers, const tile_source *source) {
    reduced_map map = passes_reduced_map_declare(context->graph, name, format, source->width,
                                                 source->height, layers, !context->marks);
    if (context->marks)
        list_tiles(context, source, name, &map);
    return map;
}

static tile_source source_of(const filter_context *context, uint32_t index, bool reduced) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    tile_source source = {.width = grid.width, .height = grid.height, .reduced = reduced};
    if (context->marks)
        source.first_mark = context->marks->first_marks[index];
    return source;
}

reduced_map passes_seen_map_declare(const filter_context *context, uint32_t index, const char *name,
                                    lobe_format format, uint32_t layers, bool reduced) {
    const tile_source source = source_of(context, index, reduced);
    return declare_map(context, name, format, layers, &source);
}

reduced_map passes_seen_map_declare_if(const filter_context *context, uint32_t index,
                                       const char *name, lobe_format format, uint32_t layers,
                                       lobe_resource condition) {
    tile_source source = source_of(context, index, true);
    source.condition = condition;
    return declare_map(context, name, format, layers, &source);
}

reduced_map passes_seen_map_declare_with(const filter_context *context, uint32_t index,
                                         const char *name, lobe_format format, uint32_t layers,
                                         bool reduced, lobe_resource made_with) {
    tile_source source = source_of(context, index, reduced);
    source.made_with = made_with;
    return declare_map(context, name, format, layers, &source);
}

reduced_map passes_seen_image_declare(const filter_context *context,
                                      const device_material *material, uint32_t index,
                                      const char *name, lobe_format format) {
    const device_map *own = &material->maps[index];
    const uint32_t first =
        context->marks ? context->marks->first_image_marks[own->image] : NO_TILE_MARKS;
    reduced_map map = passes_reduced_map_declare(context->graph, name, format, own->width,
                                                 own->height, 1, first == NO_TILE_MARKS);
    if (first == NO_TILE_MARKS)
        return map;
    const tile_source source = {
        .width = own->width,
        .height = own->height,
        .first_mark = first,
        .reduced = true,
    };
    list_tiles(context, &source, name, &map);
    return map;
}
