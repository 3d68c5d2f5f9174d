#include "engine/graph/declare/declare.h"

#include <stdio.h>

/// A retained copy under a name that is the same in every frame that exports the same, so that the
/// host's descriptors stay valid.
lobe_resource engine_graph_export_buffer(lobe_pass *pass, const char *variable,
                                         lobe_resource buffer) {
    lobe_graph *graph = pass->graph;
    const size_t size = lobe_graph_buffer_size(graph, buffer);
    char name[128];
    snprintf(name, sizeof name, "exported %s %u", variable, graph->frame.exported_buffers++);
    lobe_resource copy =
        lobe_graph_buffer(graph, &(lobe_buffer_description){name, size, .retained = true});
    lobe_pass *transfer = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "export_copy");
    return lobe_pass_copy(transfer, buffer, (lobe_range){0}, copy, (lobe_range){0});
}

void lobe_pass_export(lobe_pass *pass, const lobe_export *exported) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_EXPORT, "an export", exported))
        return;
    lobe_graph *graph = pass->graph;
    if (!exported->shader) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "pass '%s': no shader", pass->name);
        return;
    }
    engine_graph_command *command = engine_graph_add_command(pass, ENGINE_GRAPH_EXPORT);
    if (!command)
        return;
    command->export_shader = engine_arena_copy_text(&graph->frame.arena, exported->shader);
    if (!command->export_shader) {
        engine_graph_fail_memory(graph);
        return;
    }
    engine_graph_bind_to_command(pass, command, exported->bindings, exported->binding_count);
    lobe_pass_keep(pass);
}
