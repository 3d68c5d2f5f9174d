#include "passes/filters/displaced/transfer_map.h"

#include <stdio.h>
#include <string.h>

#include "passes/context/material_specialisation.h"
#include "passes/filters/displaced/relief.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"

/// What passes between the relief and the map share, of one window at a time.
typedef struct transfer_build {
    lobe_graph *graph;
    const transfer_kind *kind;
    uint32_t material;
    relief relief;
    seen_facets seen; ///< of the window
    facet_window window;
    lobe_resource colours;       ///< if they vary, otherwise anything
    lobe_resource first, others; ///< light from other facets: that has met one; all
} transfer_build;

static lobe_resource declare_facets(const transfer_build *build, const char *name, size_t bytes) {
    return lobe_graph_buffer(
        build->graph, &(lobe_buffer_description){
                          .name = name, .size = passes_window_facets(&build->window) * bytes});
}

static struct transfer_constants constants_of(const transfer_build *build, uint32_t channel) {
    struct transfer_constants constants = passes_transfer_constants(&build->relief, build->kind);
    passes_window_constants(&build->window, &constants);
    constants.channel = channel;
    return constants;
}

// ---------------------------------------------------------------------------------------------
// Colours

bool passes_lies_on_relief(const device_material *material, uint32_t map) {
    const lobe_texture_use *use = material->maps[map].use;
    return !use || (passes_maps_share_coordinates(material, map, MAP_HEIGHT) &&
                    use->wrap_u == LOBE_SCENE_WRAP_REPEAT && use->wrap_v == LOBE_SCENE_WRAP_REPEAT);
}

bool passes_has_coloured_relief(const device_material *material) {
    const device_map *colours = &material->maps[MAP_BASE_COLOUR];
    const bool colours_vary = colours->use && colours->width * colours->height > 1;
    if (!passes_has_relief(material) || (!colours_vary && !material->metallic_varies) ||
        (material->model == LOBE_MATERIAL_MICROFACET && !material->metallic_varies &&
         material->metallic >= 1))
        return false;
    return passes_lies_on_relief(material, MAP_BASE_COLOUR) &&
           (!material->metallic_varies || passes_lies_on_relief(material, MAP_WIDTH));
}

/// At how many points, along a side, colours are read in a facet so that none of a map is missed.
static uint32_t colour_points(const device_material *material) {
    const device_map *heights = &material->maps[MAP_HEIGHT];
    uint32_t points = 1;
    for (uint32_t i = 0; i < 2; i++) {
        const device_map *map = &material->maps[i == 0 ? MAP_BASE_COLOUR : MAP_WIDTH];
        if (!map->use || (i == 1 && !material->metallic_varies))
            continue;
        const uint32_t across = (map->width + heights->width - 1) / heights->width,
                       down = (map->height + heights->height - 1) / heights->height;
        points = across > points ? across : points;
        points = down > points ? down : points;
    }
    return points < 8 ? points : 8;
}

static void add_colours(const filter_context *context, transfer_build *build) {
    const device_material *material = &context->scene->materials[build->material];
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_colours");
    passes_base_map_read(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
    passes_base_map_read(context, material, MAP_WIDTH, "width_map", pass);
    build->colours = lobe_pass_write(
        pass,
        &(lobe_binding){.name = "colour_words",
                        .resource = declare_facets(build, "colours of facets",
                                                   TRANSFER_COLOUR_WORDS * sizeof(uint32_t))});
    specialisation_list list = {.graph = build->graph};
    passes_material_specialise(material, &list);
    struct colour_constants constants = {.width = build->window.width,
                                         .height = build->window.height,
                                         .points = colour_points(material),
                                         .metallic = material->values.metallic,
                                         .origin_x = build->window.x,
                                         .origin_y = build->window.y,
                                         .relief_width = build->relief.constants.width,
                                         .relief_height = build->relief.constants.height};
    memcpy(constants.base_colour, material->values.base_colour, sizeof constants.base_colour);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/facet_colours.comp",
                                              .threads = {passes_window_facets(&build->window)},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = list.items,
                                              .specialisation_count = list.count});
}

// ---------------------------------------------------------------------------------------------
// Light between facets, and the map

static lobe_resource add_bounce(const transfer_build *build, uint32_t channel, bool is_first) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_bounces");
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_words", .resource = build->seen.words});
    lobe_pass_read(pass, &(lobe_binding){.name = "link_block", .resource = build->seen.links});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = build->colours});
    // The first step reads no light: any buffer is bound.
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block",
                                         .resource = is_first ? build->seen.links : build->others});
    const lobe_resource light = lobe_pass_write(
        pass, &(lobe_binding){.name = "target_block",
                              .resource = declare_facets(build, "light between facets",
                                                         TRANSFER_INDIRECT * sizeof(float))});
    struct transfer_constants constants = constants_of(build, channel);
    constants.first = is_first;
    const kind_specialisation kind = passes_transfer_specialisation(build->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/facet_bounces.comp",
                                              .threads = {passes_window_facets(&build->window)},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = kind.items,
                                              .specialisation_count = 2});
    return light;
}

static void add_bounces(transfer_build *build, uint32_t channel) {
    build->first = build->others = add_bounce(build, channel, true);
    for (uint32_t i = 1; i < build->kind->bounces; i++)
        build->others = add_bounce(build, channel, false);
}

static uint32_t layer_count(const transfer_kind *kind) {
    return TRANSFER_FIRST_LAYERS(kind->order) +
           (kind->coloured ? 2 * TRANSFER_FURTHER_LAYERS(kind->order) : 0);
}

/// Writes a window's part of the layers of one channel.
static void write_cells(reduced_map *map, lobe_pass *pass, const transfer_kind *kind,
                        uint32_t channel, bool is_first) {
    const uint32_t first = TRANSFER_FIRST_LAYERS(kind->order),
                   further = TRANSFER_FURTHER_LAYERS(kind->order);
    const lobe_binding target = {"transfer_map", map->resource,
                                 .range = {0, 1, channel == 0 ? 0 : first + (channel - 1) * further,
                                           channel == 0 ? first : further}};
    map->resource = is_first ? lobe_pass_write(pass, &target) : lobe_pass_modify(pass, &target);
}

static lobe_pass *add_cells(const transfer_build *build, uint32_t channel, bool is_first,
                            reduced_map *map) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "cell_transfer");
    passes_relief_read(&build->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_words", .resource = build->seen.words});
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = build->others});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = build->first});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = build->colours});
    write_cells(map, pass, build->kind, channel, is_first);
    const struct transfer_constants constants = constants_of(build, channel);
    const kind_specialisation kind = passes_transfer_specialisation(build->kind);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "filters/displaced/cell_transfer.comp",
                                        .threads = {build->window.columns, build->window.rows, 1},
                                        .constants = &constants,
                                        .constants_size = sizeof constants,
                                        .specialisation = kind.items,
                                        .specialisation_count = 2});
    return pass;
}

static void add_normals(const transfer_build *build, reduced_map *map) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_normals");
    passes_relief_read(&build->relief, pass);
    passes_reduced_map_write(map, pass, "facet_map", 0);
    const struct transfer_constants constants =
        passes_transfer_constants(&build->relief, build->kind);
    lobe_dispatch dispatch = {.shader = "filters/displaced/facet_normals.comp",
                              .constants = &constants,
                              .constants_size = sizeof constants};
    passes_reduced_map_dispatch(map, pass, 0, 1, &dispatch);
    passes_level_reduction(build->graph, map);
}

static lobe_resource add_closure(const transfer_build *build, const reduced_map *map,
                                 const char *name) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "transfer_closure");
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_map",
                                         .resource = map->resource,
                                         .range = {map->levels - 1, 1, 0, map->layers}});
    lobe_pass_read(
        pass, &(lobe_binding){.name = "height_extent_block", .resource = build->relief.extent});
    lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = build->seen.basis});
    const lobe_resource closure = lobe_pass_write(
        pass,
        &(lobe_binding){.name = "closure_block",
                        .resource = lobe_graph_buffer(
                            build->graph, &(lobe_buffer_description){
                                              .name = name,
                                              .size = sizeof(struct transfer_closure_constants),
                                              .retained = true})});
    const kind_specialisation kind = passes_transfer_specialisation(build->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_closure.comp",
                                              .specialisation = kind.items,
                                              .specialisation_count = 2});
    return closure;
}

transfer_map passes_transfer_map_declare(const filter_context *context, uint32_t index,
                                         const transfer_kind *kind) {
    const device_map *heights = &context->scene->materials[index].maps[MAP_HEIGHT];
    char name[64];
    snprintf(name, sizeof name, "transfer of material %u", index);
    transfer_map result = {.map = passes_reduced_map_declare(context->graph, name, kind->format,
                                                             heights->width, heights->height,
                                                             layer_count(kind), true)};
    if (!kind->normals)
        return result;
    snprintf(name, sizeof name, "normals of facets of material %u", index);
    result.facets = passes_reduced_map_declare(context->graph, name, kind->format, heights->width,
                                               heights->height, 2 * FACET_BINS, true);
    return result;
}

uint32_t passes_transfer_images(const device_material *material, const transfer_kind *kind,
                                kept_image images[2]) {
    const device_map *heights = &material->maps[MAP_HEIGHT];
    const uint32_t width = passes_half_extent(heights->width),
                   height = passes_half_extent(heights->height),
                   levels = passes_level_count(width, height);
    images[0] = (kept_image){kind->format, width, height, layer_count(kind), levels};
    images[1] = (kept_image){kind->format, width, height, 2 * FACET_BINS, levels};
    return kind->normals ? 2 : 1;
}

uint64_t passes_transfer_facets(const transfer_kind *kind) {
    const uint64_t limit = passes_window_limit();
    return kind->most_facets > 0 && kind->most_facets < limit ? kind->most_facets : limit;
}

static window_grid grid_of(const device_material *material, const transfer_kind *kind) {
    return passes_window_grid(&material->maps[MAP_HEIGHT], passes_transfer_facets(kind));
}

bool passes_transfer_is_whole(const device_material *material, const transfer_kind *kind) {
    const window_grid grid = grid_of(material, kind);
    return grid.columns * grid.rows == 1;
}

static facet_range all_facets(const facet_window *window) {
    return (facet_range){0, passes_window_facets(window)};
}

uint32_t passes_transfer_part_count(const device_material *material, const transfer_kind *kind) {
    const window_grid grid = grid_of(material, kind);
    uint32_t count = 0;
    for (uint32_t i = 0; i < grid.columns * grid.rows; i++) {
        const facet_window window = passes_window(&grid, i);
        count += passes_facets_part_count(all_facets(&window), kind) + 1;
    }
    return count;
}

/// The passes that write a window's part of the map: a channel's layers do not depend on those of
/// the others.
typedef struct window_cells {
    lobe_pass *passes[3];
    uint32_t count;
} window_cells;

/// Light between the facets of a window, and the map's part of it.
static window_cells add_window(const filter_context *context, transfer_build *build, bool is_first,
                               reduced_map *map) {
    window_cells cells = {.count = build->kind->coloured ? 3 : 1};
    build->colours = build->seen.links;
    if (build->kind->coloured)
        add_colours(context, build);
    for (uint32_t channel = 0; channel < cells.count; channel++) {
        add_bounces(build, channel);
        cells.passes[channel] = add_cells(build, channel, is_first, map);
    }
    return cells;
}

/// What belongs to the map as a whole.
static void add_rest(transfer_build *build, transfer_map *result) {
    passes_level_reduction(build->graph, &result->map);
    if (build->kind->normals)
        add_normals(build, &result->facets);
    char name[64];
    snprintf(name, sizeof name, "closure of material %u", build->material);
    result->closure = add_closure(build, &result->map, name);
}

/// One window after the other, as far as `parts` goes. False: some are left.
static bool add_windows(const filter_context *context, transfer_build *build,
                        const facets_request *request, const window_grid *grid, uint32_t parts,
                        reduced_map *map) {
    window_cells last = {.count = 0}; // of the windows before, whose facets are no longer there
    for (uint32_t i = 0; i < grid->columns * grid->rows; i++) {
        build->window = passes_window(grid, i);
        const facet_range all = all_facets(&build->window);
        const uint32_t needed = passes_facets_part_count(all, build->kind) + 1;
        const bool is_current = parts <= needed;
        passes_facets_add(request, &build->window, all, parts, request->in_parts && is_current,
                          &build->seen);
        if (parts < needed) {
            for (uint32_t k = 0; request->in_parts && k < last.count; k++)
                lobe_pass_keep(last.passes[k]);
            return false;
        }
        parts -= needed;
        last = add_window(context, build, i == 0, map);
    }
    return true;
}

/// The largest window of a grid: the first.
static uint32_t most_facets(const window_grid *grid) {
    const facet_window window = passes_window(grid, 0);
    return passes_window_facets(&window);
}

transfer_map passes_transfer_map(const filter_context *context, uint32_t index,
                                 const transfer_kind *kind, const relief *relief,
                                 const seen_facets *seen, uint32_t parts, bool in_parts) {
    const window_grid grid = grid_of(&context->scene->materials[index], kind);
    const facets_request request = {context->graph, index, relief, kind, in_parts};
    transfer_map result = passes_transfer_map_declare(context, index, kind);
    transfer_build build = {
        .graph = context->graph,
        .kind = kind,
        .material = index,
        .relief = *relief,
        .seen = seen ? *seen : passes_facets_begin(&request, most_facets(&grid)),
        .window = passes_window(&grid, 0),
    };
    bool is_whole = seen != NULL;
    if (seen)
        add_window(context, &build, true, &result.map);
    else
        is_whole = add_windows(context, &build, &request, &grid, parts, &result.map);
    if (is_whole)
        add_rest(&build, &result);
    return result;
}
