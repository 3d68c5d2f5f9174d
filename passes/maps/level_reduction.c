#include "passes/maps/level_reduction.h"

#include "shaders/interface/map_tiles.h"

uint32_t passes_half_extent(uint32_t size) {
    return size > 1 ? size / 2 : 1;
}

uint32_t passes_level_count(uint32_t width, uint32_t height) {
    uint32_t count = 1;
    for (uint32_t size = width > height ? width : height; size > 1; size /= 2)
        ++count;
    return count;
}

uint64_t passes_reduced_map_bytes(const reduced_map *map, lobe_format format) {
    uint64_t texels = 0;
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 0; level < map->levels; level++) {
        texels += (uint64_t)width * height;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
    return texels * map->layers * lobe_format_size(format);
}

reduced_map passes_reduced_map_declare(lobe_graph *graph, const char *name, lobe_format format,
                                       uint32_t width, uint32_t height, uint32_t layers,
                                       bool whole) {
    reduced_map map = {
        .width = passes_half_extent(width), .height = passes_half_extent(height), .layers = layers};
    map.levels = passes_level_count(map.width, map.height);
    map.resource = lobe_graph_image(graph, &(lobe_image_description){.name = name,
                                                                     .format = format,
                                                                     .width = map.width,
                                                                     .height = map.height,
                                                                     .layers = layers,
                                                                     .levels = map.levels,
                                                                     .retained = true,
                                                                     .shared = whole});
    return map;
}

/// The level that a step reads: of the map itself, or of the map it is made from.
typedef struct source_level {
    lobe_resource resource;
    uint32_t level;
    uint32_t width, height;
} source_level;

void passes_reduced_map_write(reduced_map *map, lobe_pass *pass, const char *name, uint32_t level) {
    const lobe_binding target = {name, map->resource, .range = {level, 1, 0, map->layers}};
    map->resource = map->keeps ? lobe_pass_modify(pass, &target) : lobe_pass_write(pass, &target);
}

static uint32_t extent_at(uint32_t size, uint32_t level) {
    return size >> level > 0 ? size >> level : 1;
}

/// `texels`: how many of the level an invocation makes, each way.
static void dispatch_level(const reduced_map *map, lobe_pass *pass, uint32_t level, uint32_t layers,
                           uint32_t texels, lobe_dispatch *dispatch) {
    if (map->tiles.version > 0) {
        lobe_pass_read(pass, &(lobe_binding){.name = "tile_list_block", .resource = map->tiles});
        dispatch->indirect = map->tiles;
        dispatch->indirect_offset = level * MAP_TILE_RECORD * sizeof(uint32_t);
    } else if (map->groups.version > 0) {
        dispatch->indirect = map->groups;
        dispatch->indirect_offset = map->groups_offset + level * 4 * sizeof(uint32_t);
    }
    dispatch->threads[0] = extent_at(map->width, level) / texels;
    dispatch->threads[1] = extent_at(map->height, level) / texels;
    dispatch->threads[2] = layers;
    lobe_pass_dispatch(pass, dispatch);
}

void passes_reduced_map_dispatch(const reduced_map *map, lobe_pass *pass, uint32_t level,
                                 uint32_t layers, lobe_dispatch *dispatch) {
    dispatch_level(map, pass, level, layers, 1, dispatch);
}

/// The pass that writes three levels at once needs sizes that are multiples of eight.
static bool can_tile(const reduced_map *map, const source_level *source, uint32_t first) {
    return source->width % 8 == 0 && source->height % 8 == 0 && first + 3 <= map->levels;
}

static const char *const shaders[2][2] = {
    {"maps/level_reduction.comp", "maps/level_reduction_seen_tiles.comp"},
    {"maps/level_reduction_tiled.comp", "maps/level_reduction_tiled_seen_tiles.comp"}};

/// Fills one or three levels from `first` on; returns their number.
static uint32_t reduce_step(lobe_graph *graph, reduced_map *map, const source_level *source,
                            uint32_t first) {
    bool tiled = can_tile(map, source, first);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "level_reduction");
    lobe_pass_read(pass, &(lobe_binding){"source", source->resource,
                                         .range = {source->level, 1, 0, map->layers}});
    if (tiled) {
        passes_reduced_map_write(map, pass, "target_1", first);
        passes_reduced_map_write(map, pass, "target_2", first + 1);
        passes_reduced_map_write(map, pass, "target_3", first + 2);
    } else {
        passes_reduced_map_write(map, pass, "target", first);
    }
    const bool seen = map->tiles.version > 0;
    lobe_dispatch dispatch = {.shader = shaders[tiled][seen],
                              .constants = seen ? &first : NULL,
                              .constants_size = seen ? sizeof first : 0};
    dispatch_level(map, pass, first, map->layers, tiled ? 2 : 1, &dispatch);
    return tiled ? 3 : 1;
}

/// Fills all levels from `first` on.
static void reduce_all(lobe_graph *graph, reduced_map *map, source_level source, uint32_t first) {
    while (first < map->levels) {
        uint32_t count = reduce_step(graph, map, &source, first);
        first += count;
        for (; count > 0; --count) {
            source.width = passes_half_extent(source.width);
            source.height = passes_half_extent(source.height);
        }
        source.resource = map->resource;
        source.level = first - 1;
    }
}

void passes_level_reduction_from(lobe_graph *graph, reduced_map *map, lobe_resource source,
                                 uint32_t width, uint32_t height) {
    reduce_all(graph, map, (source_level){source, 0, width, height}, 0);
}

void passes_level_reduction(lobe_graph *graph, reduced_map *map) {
    reduce_all(graph, map, (source_level){map->resource, 0, map->width, map->height}, 1);
}
