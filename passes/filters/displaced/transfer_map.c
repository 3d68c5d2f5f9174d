#include "passes/filters/displaced/transfer_map.h"

#include <stdio.h>
#include <string.h>

#include "passes/context/material_specialisation.h"
#include "passes/filters/displaced/relief.h"
#include "passes/maps/lobe_map.h"

/// What passes between the relief and the map share.
typedef struct transfer_build {
    lobe_graph *graph;
    const transfer_kind *kind;
    uint32_t material;
    relief relief;
    uint32_t facets;
    lobe_resource basis; ///< struct transfer_basis_constants
    lobe_resource words; ///< b of each facet
    lobe_resource links;
    lobe_resource colours;       ///< if they vary, otherwise anything
    lobe_resource first, others; ///< light from other facets: that has met one; all
} transfer_build;

static lobe_resource declare_facets(const transfer_build *build, const char *name, size_t bytes) {
    return lobe_graph_buffer(
        build->graph,
        &(lobe_buffer_description){.name = name, .size = (size_t)build->facets * bytes});
}

/// What colours do not change outlives the frame where these can.
static lobe_resource declare_kept(const transfer_build *build, const char *name, size_t size) {
    char of_material[64];
    snprintf(of_material, sizeof of_material, "%s of material %u", name, build->material);
    return lobe_graph_buffer(
        build->graph, &(lobe_buffer_description){
                          .name = of_material, .size = size, .retained = build->kind->coloured});
}

static struct transfer_constants constants_of(const transfer_build *build) {
    return (struct transfer_constants){.width = build->relief.constants.width,
                                       .height = build->relief.constants.height,
                                       .azimuths = build->kind->azimuths};
}

/// The map's number of functions, and whether its colours vary, as constants of a shader.
typedef struct kind_specialisation {
    lobe_specialisation items[2];
} kind_specialisation;

static kind_specialisation specialisation_of(const transfer_kind *kind) {
    return (kind_specialisation){
        {{SPECIALISE_TRANSFER_ORDER, kind->order}, {SPECIALISE_TRANSFER_COLOURED, kind->coloured}}};
}

static void dispatch(const transfer_build *build, const char *shader, uint32_t threads,
                     lobe_pass *pass) {
    const struct transfer_constants constants = constants_of(build);
    const kind_specialisation kind = specialisation_of(build->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = shader,
                                              .threads = {threads},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = kind.items,
                                              .specialisation_count = 2});
}

static uint32_t basis_cells(uint32_t quads) {
    const uint32_t cells = (quads + TRANSFER_BASIS_CELL - 1) / TRANSFER_BASIS_CELL;
    return cells < TRANSFER_BASIS_MAXIMUM ? cells : TRANSFER_BASIS_MAXIMUM;
}

static void add_basis(transfer_build *build) {
    const uint32_t across = basis_cells(build->relief.constants.width),
                   down = basis_cells(build->relief.constants.height), count = across * down;
    lobe_resource cells = lobe_graph_buffer(
        build->graph, &(lobe_buffer_description){.name = "cells of basis",
                                                 .size = (size_t)count * TRANSFER_BASIS_TERMS *
                                                         TRANSFER_BASIS_TERMS * sizeof(float)});
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "basis_cells");
    passes_relief_read(&build->relief, pass);
    cells = lobe_pass_write(pass, &(lobe_binding){.name = "cell_block", .resource = cells});
    const struct transfer_constants constants = constants_of(build);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/basis_cells.comp",
                                              .threads = {across * TRANSFER_BASIS_POINTS,
                                                          down * TRANSFER_BASIS_POINTS},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "transfer_basis");
    lobe_pass_read(pass, &(lobe_binding){.name = "cell_block", .resource = cells});
    build->basis = lobe_pass_write(
        pass, &(lobe_binding){.name = "basis_block",
                              .resource = declare_kept(build, "functions of directions",
                                                       sizeof(struct transfer_basis_constants))});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_basis.comp",
                                              .threads = {TRANSFER_BASIS_TERMS},
                                              .constants = &count,
                                              .constants_size = sizeof count});
}

static void add_transfer(transfer_build *build) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_transfer");
    passes_relief_read(&build->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = build->basis});
    build->words = lobe_pass_write(
        pass, &(lobe_binding){.name = "transfer_words",
                              .resource =
                                  declare_kept(build, "transfer of facets",
                                               build->facets * TRANSFER_WORDS(build->kind->order) *
                                                   sizeof(uint32_t))});
    dispatch(build, "filters/displaced/facet_transfer.comp", build->facets / 2, pass);
}

static void add_links(transfer_build *build) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_links");
    passes_relief_read(&build->relief, pass);
    build->links = lobe_pass_write(
        pass, &(lobe_binding){.name = "link_block",
                              .resource =
                                  declare_kept(build, "links of facets",
                                               build->facets * TRANSFER_LINKS * sizeof(uint32_t))});
    dispatch(build, "filters/displaced/facet_links.comp", build->facets, pass);
}

// ---------------------------------------------------------------------------------------------
// Colours

bool passes_lies_on_relief(const lobe_material *material, const lobe_texture_use *use) {
    const lobe_texture_use *heights = &material->height_map;
    return use->texture_coordinates == heights->texture_coordinates &&
           memcmp(use->transform, heights->transform, sizeof use->transform) == 0 &&
           use->wrap_u == LOBE_SCENE_WRAP_REPEAT && use->wrap_v == LOBE_SCENE_WRAP_REPEAT;
}

bool passes_has_coloured_relief(const device_material *material) {
    const device_map *colours = &material->maps[MAP_BASE_COLOUR],
                     *widths = &material->maps[MAP_WIDTH];
    const bool colours_vary = colours->use && colours->width * colours->height > 1;
    if (!passes_has_relief(material) || (!colours_vary && !material->metallic_varies) ||
        (material->model == LOBE_MATERIAL_MICROFACET && !material->metallic_varies &&
         material->metallic >= 1))
        return false;
    return (!colours->use || passes_lies_on_relief(material->material, colours->use)) &&
           (!material->metallic_varies || passes_lies_on_relief(material->material, widths->use));
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
    struct colour_constants constants = {.width = build->relief.constants.width,
                                         .height = build->relief.constants.height,
                                         .points = colour_points(material),
                                         .metallic = material->values.metallic};
    memcpy(constants.base_colour, material->values.base_colour, sizeof constants.base_colour);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/facet_colours.comp",
                                              .threads = {build->facets},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = list.items,
                                              .specialisation_count = list.count});
}

// ---------------------------------------------------------------------------------------------
// Light between facets, and the map

static lobe_resource add_bounce(const transfer_build *build, uint32_t channel, bool is_first) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_bounces");
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_words", .resource = build->words});
    lobe_pass_read(pass, &(lobe_binding){.name = "link_block", .resource = build->links});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = build->colours});
    // The first step reads no light: any buffer is bound.
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block",
                                         .resource = is_first ? build->links : build->others});
    const lobe_resource light = lobe_pass_write(
        pass, &(lobe_binding){.name = "target_block",
                              .resource = declare_facets(build, "light between facets",
                                                         TRANSFER_INDIRECT * sizeof(float))});
    struct transfer_constants constants = constants_of(build);
    constants.first = is_first;
    constants.channel = channel;
    const kind_specialisation kind = specialisation_of(build->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/facet_bounces.comp",
                                              .threads = {build->facets},
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

/// Writes the layers of one channel.
static void write_cells(reduced_map *map, lobe_pass *pass, const transfer_kind *kind,
                        uint32_t channel) {
    const uint32_t first = TRANSFER_FIRST_LAYERS(kind->order),
                   further = TRANSFER_FURTHER_LAYERS(kind->order);
    const lobe_binding target = {"transfer_map", map->resource,
                                 .range = {0, 1, channel == 0 ? 0 : first + (channel - 1) * further,
                                           channel == 0 ? first : further}};
    map->resource = lobe_pass_write(pass, &target);
}

static void add_cells(const transfer_build *build, uint32_t channel, reduced_map *map) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "cell_transfer");
    passes_relief_read(&build->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_words", .resource = build->words});
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = build->others});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = build->first});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = build->colours});
    write_cells(map, pass, build->kind, channel);
    struct transfer_constants constants = constants_of(build);
    constants.channel = channel;
    const kind_specialisation kind = specialisation_of(build->kind);
    lobe_dispatch dispatch = {.shader = "filters/displaced/cell_transfer.comp",
                              .constants = &constants,
                              .constants_size = sizeof constants,
                              .specialisation = kind.items,
                              .specialisation_count = 2};
    passes_reduced_map_dispatch(map, pass, 0, 1, &dispatch);
}

static void add_normals(const transfer_build *build, reduced_map *map) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_normals");
    passes_relief_read(&build->relief, pass);
    passes_reduced_map_write(map, pass, "facet_map", 0);
    const struct transfer_constants constants = constants_of(build);
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
    lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = build->basis});
    const lobe_resource closure = lobe_pass_write(
        pass,
        &(lobe_binding){.name = "closure_block",
                        .resource = lobe_graph_buffer(
                            build->graph, &(lobe_buffer_description){
                                              .name = name,
                                              .size = sizeof(struct transfer_closure_constants),
                                              .retained = true})});
    const kind_specialisation kind = specialisation_of(build->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_closure.comp",
                                              .specialisation = kind.items,
                                              .specialisation_count = 2});
    return closure;
}

/// What Vulkan asks of every device: buffers of 128 MiB.
static bool fits(const filter_context *context, const device_material *material,
                 const transfer_kind *kind) {
    const uint64_t largest = (uint64_t)1 << 27;
    const device_map *map = &material->maps[MAP_HEIGHT];
    const uint64_t facets = 2 * (uint64_t)map->width * map->height;
    // Of each facet, words, links, and light of four functions.
    uint64_t words = TRANSFER_WORDS(kind->order);
    words = words > TRANSFER_LINKS ? words : TRANSFER_LINKS;
    if (facets * words * sizeof(uint32_t) <= largest)
        return true;
    lobe_graph_fail(context->graph, LOBE_ERROR_LIMIT,
                    "%s: a height map of %u x %u texels is too large for filter '%s': it has more "
                    "than %.1f million",
                    material->material->name, map->width, map->height,
                    lobe_filter_name(context->filter), (double)(largest / words / 8) * 1e-6);
    return false;
}

transfer_map passes_transfer_map(const filter_context *context, uint32_t index,
                                 const transfer_kind *kind) {
    const device_material *material = &context->scene->materials[index];
    if (!fits(context, material, kind))
        return (transfer_map){0};
    transfer_build build = {
        .graph = context->graph,
        .kind = kind,
        .material = index,
        .relief = passes_relief(context, index, false),
    };
    const uint32_t width = build.relief.constants.width, height = build.relief.constants.height;
    build.facets = 2 * width * height;
    char name[64];
    snprintf(name, sizeof name, "transfer of material %u", index);
    transfer_map result = {.map =
                               passes_reduced_map_declare(context->graph, name, kind->format, width,
                                                          height, layer_count(kind), true)};
    add_basis(&build);
    add_transfer(&build);
    add_links(&build);
    build.colours = build.links;
    if (kind->coloured)
        add_colours(context, &build);
    for (uint32_t channel = 0; channel < (kind->coloured ? 3 : 1); channel++) {
        add_bounces(&build, channel);
        add_cells(&build, channel, &result.map);
    }
    passes_level_reduction(context->graph, &result.map);
    if (kind->normals) {
        snprintf(name, sizeof name, "normals of facets of material %u", index);
        result.facets = passes_reduced_map_declare(context->graph, name, kind->format, width,
                                                   height, 2 * FACET_BINS, true);
        add_normals(&build, &result.facets);
    }
    snprintf(name, sizeof name, "closure of material %u", index);
    result.closure = add_closure(&build, &result.map, name);
    return result;
}
