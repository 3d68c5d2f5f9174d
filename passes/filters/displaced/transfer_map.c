#include "passes/filters/displaced/transfer_map.h"

#include <stdio.h>

#include "passes/filters/displaced/relief.h"

/// What passes between the relief and the map share.
typedef struct transfer_build {
    lobe_graph *graph;
    const transfer_kind *kind;
    relief relief;
    uint32_t facets;
    lobe_resource words; ///< b of each facet
    lobe_resource links;
    lobe_resource first, others; ///< light from other facets: that has met one; all
} transfer_build;

static lobe_resource declare_facets(const transfer_build *build, const char *name, size_t bytes) {
    return lobe_graph_buffer(
        build->graph,
        &(lobe_buffer_description){.name = name, .size = (size_t)build->facets * bytes});
}

static void dispatch(const transfer_build *build, const char *shader, uint32_t threads,
                     uint32_t first, lobe_pass *pass) {
    const struct transfer_constants constants = {build->relief.constants.width,
                                                 build->relief.constants.height,
                                                 build->kind->azimuths, first};
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = shader,
                                              .threads = {threads},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
}

static void add_transfer(transfer_build *build) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_transfer");
    passes_relief_read(&build->relief, pass);
    build->words = lobe_pass_write(
        pass, &(lobe_binding){.name = "transfer_words",
                              .resource = declare_facets(build, "transfer of facets",
                                                         TRANSFER_WORDS * sizeof(uint32_t))});
    dispatch(build, "filters/displaced/facet_transfer.comp", build->facets / 2, 0, pass);
}

static void add_links(transfer_build *build) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_links");
    passes_relief_read(&build->relief, pass);
    build->links = lobe_pass_write(
        pass, &(lobe_binding){.name = "link_block",
                              .resource = declare_facets(build, "links of facets",
                                                         TRANSFER_LINKS * sizeof(uint32_t))});
    dispatch(build, "filters/displaced/facet_links.comp", build->facets, 0, pass);
}

static lobe_resource add_bounce(const transfer_build *build, bool is_first) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_bounces");
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_words", .resource = build->words});
    lobe_pass_read(pass, &(lobe_binding){.name = "link_block", .resource = build->links});
    // The first step reads no light: any buffer is bound.
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block",
                                         .resource = is_first ? build->links : build->others});
    const lobe_resource light = lobe_pass_write(
        pass, &(lobe_binding){.name = "target_block",
                              .resource = declare_facets(build, "light between facets",
                                                         TRANSFER_INDIRECT * sizeof(float))});
    dispatch(build, "filters/displaced/facet_bounces.comp", build->facets, is_first, pass);
    return light;
}

static void add_bounces(transfer_build *build) {
    build->first = build->others = add_bounce(build, true);
    for (uint32_t i = 1; i < build->kind->bounces; i++)
        build->others = add_bounce(build, false);
}

static uint32_t layer_count(const transfer_kind *kind) {
    const uint32_t direct = kind->order * (kind->order + 1) / 2;
    return (direct + TRANSFER_INDIRECT_COUNT + 1 + kind->order + 3) / 4;
}

static void add_cells(const transfer_build *build, reduced_map *map) {
    const uint32_t width = build->relief.constants.width, height = build->relief.constants.height;
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "cell_transfer");
    passes_relief_read(&build->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "transfer_words", .resource = build->words});
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = build->others});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = build->first});
    passes_reduced_map_write(map, pass, "transfer_map", 0);
    const struct transfer_constants constants = {width, height, build->kind->azimuths, 0};
    const lobe_specialisation order = {SPECIALISE_TRANSFER_ORDER, build->kind->order};
    lobe_dispatch dispatch = {.shader = "filters/displaced/cell_transfer.comp",
                              .constants = &constants,
                              .constants_size = sizeof constants,
                              .specialisation = &order,
                              .specialisation_count = 1};
    passes_reduced_map_dispatch(map, pass, 0, 1, &dispatch);
    passes_level_reduction(build->graph, map);
}

static void add_normals(const transfer_build *build, reduced_map *map) {
    lobe_pass *pass = lobe_graph_add_pass(build->graph, LOBE_PASS_COMPUTE, "facet_normals");
    passes_relief_read(&build->relief, pass);
    passes_reduced_map_write(map, pass, "facet_map", 0);
    const struct transfer_constants constants = {
        build->relief.constants.width, build->relief.constants.height, build->kind->azimuths, 0};
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
    const lobe_resource closure = lobe_pass_write(
        pass,
        &(lobe_binding){.name = "closure_block",
                        .resource = lobe_graph_buffer(
                            build->graph, &(lobe_buffer_description){
                                              .name = name,
                                              .size = sizeof(struct transfer_closure_constants),
                                              .retained = true})});
    const lobe_specialisation order = {SPECIALISE_TRANSFER_ORDER, build->kind->order};
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "filters/displaced/transfer_closure.comp",
                                              .specialisation = &order,
                                              .specialisation_count = 1});
    return closure;
}

/// What Vulkan asks of every device: buffers of 128 MiB.
static bool fits(const filter_context *context, const device_material *material) {
    const uint64_t largest = (uint64_t)1 << 27;
    const device_map *map = &material->maps[MAP_HEIGHT];
    const uint64_t facets = 2 * (uint64_t)map->width * map->height;
    if (facets * TRANSFER_WORDS * sizeof(uint32_t) <= largest)
        return true;
    lobe_graph_fail(context->graph, LOBE_ERROR_LIMIT,
                    "%s: a height map of %u x %u texels is too large for filter '%s': it has more "
                    "than 3.3 million",
                    material->material->name, map->width, map->height,
                    lobe_filter_name(context->filter));
    return false;
}

transfer_map passes_transfer_map(const filter_context *context, uint32_t index,
                                 const transfer_kind *kind) {
    const device_material *material = &context->scene->materials[index];
    if (!fits(context, material))
        return (transfer_map){0};
    transfer_build build = {
        .graph = context->graph, .kind = kind, .relief = passes_relief(context, index, false)};
    const uint32_t width = build.relief.constants.width, height = build.relief.constants.height;
    build.facets = 2 * width * height;
    char name[64];
    snprintf(name, sizeof name, "transfer of material %u", index);
    transfer_map result = {.map =
                               passes_reduced_map_declare(context->graph, name, kind->format, width,
                                                          height, layer_count(kind), true)};
    add_transfer(&build);
    add_links(&build);
    add_bounces(&build);
    add_cells(&build, &result.map);
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
