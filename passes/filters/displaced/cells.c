#include "passes/filters/displaced/cells.h"

#include "passes/filters/displaced/facet_colours.h"
#include "passes/filters/displaced/facet_emission.h"
#include "passes/maps/base_maps.h"
#include "passes/upload/material_maps.h"

/// What the passes of a window share.
typedef struct cells_build {
    const cells_source *source;
    const cells_target *target;
    lobe_resource colours;       ///< if they vary, otherwise anything
    lobe_resource first, others; ///< light from other facets: that has met one; all
} cells_build;

static lobe_resource declare_facets(const cells_build *build, const char *name, size_t bytes) {
    return lobe_graph_buffer(
        build->source->context->graph,
        &(lobe_buffer_description){.name = name,
                                   .size = passes_window_facets(build->source->window) * bytes});
}

static struct transfer_constants constants_of(const cells_build *build, uint32_t channel) {
    const cells_source *source = build->source;
    struct transfer_constants constants = passes_transfer_constants(source->relief, source->kind);
    passes_window_constants(source->window, &constants);
    constants.target_column = build->target->column;
    constants.target_row = build->target->row;
    constants.channel = channel;
    return constants;
}

// ---------------------------------------------------------------------------------------------
// Light between facets

static lobe_resource add_bounce(const cells_build *build, uint32_t channel, bool is_first) {
    lobe_pass *pass =
        lobe_graph_add_pass(build->source->context->graph, LOBE_PASS_COMPUTE, "facet_bounces");
    lobe_pass_read(
        pass, &(lobe_binding){.name = "transfer_words", .resource = build->source->seen->words});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "link_block", .resource = build->source->seen->links});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = build->colours});
    // The first step reads no light: any buffer is bound.
    lobe_pass_read(
        pass, &(lobe_binding){.name = "source_block",
                              .resource = is_first ? build->source->seen->links : build->others});
    const lobe_resource light = lobe_pass_write(
        pass, &(lobe_binding){.name = "target_block",
                              .resource = declare_facets(build, "light between facets",
                                                         TRANSFER_INDIRECT * sizeof(float))});
    struct transfer_constants constants = constants_of(build, channel);
    constants.first = is_first;
    const kind_specialisation kind = passes_transfer_specialisation(build->source->kind);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "filters/displaced/facet_bounces.comp",
                                        .threads = {passes_window_facets(build->source->window)},
                                        .constants = &constants,
                                        .constants_size = sizeof constants,
                                        .specialisation = kind.items,
                                        .specialisation_count = KIND_CONSTANTS});
    return light;
}

static void add_bounces(cells_build *build, uint32_t channel) {
    build->first = build->others = add_bounce(build, channel, true);
    for (uint32_t i = 1; i < build->source->kind->bounces; i++)
        build->others = add_bounce(build, channel, false);
}

// ---------------------------------------------------------------------------------------------
// Texels

uint32_t passes_transfer_layers(const transfer_kind *kind) {
    return TRANSFER_CHANNEL_LAYERS(kind->order, kind->coloured) +
           (kind->emissive ? TRANSFER_EMISSION_LAYERS(kind->order) : 0);
}

uint32_t passes_facet_layers(const transfer_kind *kind) {
    return (kind->widths ? 3 : 2) * FACET_BINS;
}

static void write_layers(const cells_build *build, lobe_pass *pass, uint32_t first,
                         uint32_t count) {
    reduced_map *map = build->target->transfer;
    const lobe_binding target = {"transfer_map", map->resource, .range = {0, 1, first, count}};
    map->resource = map->keeps ? lobe_pass_modify(pass, &target) : lobe_pass_write(pass, &target);
}

/// Binds the layers of one channel.
static void write_channel(const cells_build *build, lobe_pass *pass, uint32_t channel) {
    const uint32_t order = build->source->kind->order, first = TRANSFER_FIRST_LAYERS(order),
                   further = TRANSFER_FURTHER_LAYERS(order);
    write_layers(build, pass, channel == 0 ? 0 : first + (channel - 1) * further,
                 channel == 0 ? first : further);
}

static void dispatch(const cells_build *build, lobe_pass *pass, const char *shader,
                     uint32_t channel) {
    const facet_window *window = build->source->window;
    const struct transfer_constants constants = constants_of(build, channel);
    const kind_specialisation kind = passes_transfer_specialisation(build->source->kind);
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = shader,
                                              .threads = {window->columns, window->rows, 1},
                                              .constants = &constants,
                                              .constants_size = sizeof constants,
                                              .specialisation = kind.items,
                                              .specialisation_count = KIND_CONSTANTS});
}

static lobe_pass *add_transfer(const cells_build *build, uint32_t channel) {
    const cells_source *source = build->source;
    lobe_pass *pass =
        lobe_graph_add_pass(source->context->graph, LOBE_PASS_COMPUTE, "cell_transfer");
    passes_relief_read(source->relief, pass);
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "transfer_words", .resource = source->seen->words});
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = build->others});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = build->first});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = build->colours});
    write_channel(build, pass, channel);
    dispatch(build, pass, "filters/displaced/cell_transfer.comp", channel);
    return pass;
}

static lobe_pass *add_emission(const cells_build *build, lobe_resource colours) {
    const cells_source *source = build->source;
    const facet_emission light = passes_facet_emission(source, colours);
    lobe_pass *pass =
        lobe_graph_add_pass(source->context->graph, LOBE_PASS_COMPUTE, "cell_emission");
    passes_relief_read(source->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = source->seen->basis});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "transfer_words", .resource = source->seen->words});
    lobe_pass_read(pass, &(lobe_binding){.name = "source_block", .resource = light.sent});
    lobe_pass_read(pass, &(lobe_binding){.name = "emitted_block", .resource = light.emitted});
    const transfer_kind *kind = source->kind;
    write_layers(build, pass, TRANSFER_CHANNEL_LAYERS(kind->order, kind->coloured),
                 TRANSFER_EMISSION_LAYERS(kind->order));
    dispatch(build, pass, "filters/displaced/emission/cell_emission.comp", 0);
    return pass;
}

static lobe_pass *add_normals(const cells_build *build) {
    const cells_source *source = build->source;
    lobe_pass *pass =
        lobe_graph_add_pass(source->context->graph, LOBE_PASS_COMPUTE, "facet_normals");
    passes_relief_read(source->relief, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "basis_block", .resource = source->seen->basis});
    lobe_pass_read(pass,
                   &(lobe_binding){.name = "transfer_words", .resource = source->seen->words});
    passes_reduced_map_write(build->target->facets, pass, "facet_map", 0);
    if (source->kind->widths)
        passes_base_map_read(source->context, &source->context->scene->materials[source->material],
                             MAP_WIDTH, "width_map", pass);
    else
        lobe_pass_read(pass,
                       &(lobe_binding){.name = "width_map",
                                       .resource = lobe_graph_import_texture(
                                           source->context->graph, source->context->scene->white)});
    dispatch(build, pass, "filters/displaced/facet_normals.comp", 0);
    return pass;
}

cell_passes passes_cells_add(const cells_source *source, const cells_target *target) {
    cells_build build = {.source = source, .target = target, .colours = source->seen->links};
    cell_passes cells = {.count = source->kind->coloured ? 3 : 1};
    lobe_resource colours = build.colours;
    if (source->kind->coloured || source->kind->emissive)
        colours =
            passes_facet_colours(source->context, source->material, source->relief, source->window);
    if (source->kind->coloured)
        build.colours = colours;
    for (uint32_t channel = 0; channel < cells.count; channel++) {
        add_bounces(&build, channel);
        cells.passes[channel] = add_transfer(&build, channel);
    }
    if (source->kind->emissive)
        cells.passes[cells.count++] = add_emission(&build, colours);
    if (source->kind->normals)
        cells.passes[cells.count++] = add_normals(&build);
    return cells;
}
