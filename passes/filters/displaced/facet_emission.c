#include "passes/filters/displaced/facet_emission.h"

#include "passes/maps/base_maps.h"

/// Colours of facets count, also where they do not vary.
static kind_specialisation specialisation_of(const transfer_kind *kind) {
    transfer_kind coloured = *kind;
    coloured.coloured = true;
    return passes_transfer_specialisation(&coloured);
}

/// `before`: of the step before; NULL: the first.
static lobe_resource add_step(const cells_source *source, lobe_resource colours,
                              const facet_emission *before) {
    lobe_graph *graph = source->context->graph;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "facet_emission");
    passes_relief_read(source->relief, pass);
    passes_base_map_read(source->context, &source->context->scene->materials[source->material],
                         MAP_EMISSIVE, "emissive_map", pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "link_block", .resource = source->seen->links});
    lobe_pass_read(pass, &(lobe_binding){.name = "colour_words", .resource = colours});
    // The first step reads no light: any buffer is bound.
    const lobe_resource links = source->seen->links;
    lobe_pass_read(pass, &(lobe_binding){.name = "emitted_block",
                                         .resource = before ? before->emitted : links});
    lobe_pass_read(
        pass, &(lobe_binding){.name = "source_block", .resource = before ? before->sent : links});
    const uint32_t facets = passes_window_facets(source->window);
    const lobe_resource light = lobe_pass_write(
        pass, &(lobe_binding){.name = "target_block",
                              .resource = lobe_graph_buffer(
                                  graph, &(lobe_buffer_description){
                                             .name = "light of shining facets",
                                             .size = (size_t)facets * 4 * sizeof(float)})});
    struct transfer_constants constants = passes_transfer_constants(source->relief, source->kind);
    passes_window_constants(source->window, &constants);
    constants.first = !before;
    const kind_specialisation kind = specialisation_of(source->kind);
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "filters/displaced/emission/facet_emission.comp",
                                        .threads = {facets},
                                        .constants = &constants,
                                        .constants_size = sizeof constants,
                                        .specialisation = kind.items,
                                        .specialisation_count = KIND_CONSTANTS});
    return light;
}

facet_emission passes_facet_emission(const cells_source *source, lobe_resource colours) {
    facet_emission light = {.emitted = add_step(source, colours, NULL)};
    light.sent = light.emitted;
    for (uint32_t i = 0; i < source->kind->bounces; i++)
        light.sent = add_step(source, colours, &light);
    return light;
}
