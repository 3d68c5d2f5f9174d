#include "engine/graph/record/record.h"

#include <lobe/vulkan.h>

#include "engine/graph/declare/declare.h"
#include "engine/shader/shaders.h"

static lobe_result add_variable(lobe_graph *graph, const lobe_pass *pass,
                                engine_graph_command *command,
                                const engine_shader_binding *variable) {
    const engine_graph_binding *binding = engine_graph_find_binding(pass, command, variable->name);
    if (!binding)
        return LOBE_OK;
    lobe_vulkan_descriptor *descriptor = &command->exported[command->exported_count++];
    *descriptor = (lobe_vulkan_descriptor){.binding = variable->binding, .type = variable->type};
    lobe_result result =
        engine_graph_describe(graph, binding, variable, &descriptor->image, &descriptor->buffer);
    engine_graph_retained *kept =
        graph->frame.resources[graph->frame.dependencies.accesses[binding->access].resource]
            .retained;
    if (kept)
        kept->exported = true;
    // Host images are back in the layout that the host asked for.
    const lobe_vulkan_image *host =
        graph->frame.resources[graph->frame.dependencies.accesses[binding->access].resource].host;
    if (host)
        descriptor->image.imageLayout =
            host->final_layout ? host->final_layout : VK_IMAGE_LAYOUT_GENERAL;
    return result;
}

static lobe_result describe(lobe_graph *graph, const lobe_pass *pass,
                            engine_graph_command *command) {
    const engine_shader *shader;
    lobe_result result = engine_shader_find(graph->device, command->export_shader, &shader);
    if (result != LOBE_OK)
        return engine_graph_propagate(graph, result);
    command->exported = engine_arena_allocate(&graph->frame.arena, (shader->binding_count + 1) *
                                                                       sizeof *command->exported);
    if (!command->exported)
        return engine_graph_fail_memory(graph);
    for (size_t i = 0; result == LOBE_OK && i < shader->binding_count; i++)
        result = add_variable(graph, pass, command, &shader->bindings[i]);
    return result;
}

lobe_result engine_graph_describe_exports(lobe_graph *graph) {
    lobe_result result = LOBE_OK;
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++) {
        lobe_pass *pass = graph->frame.passes[i];
        for (engine_graph_command *command = pass->first_command; command && result == LOBE_OK;
             command = command->next)
            if (command->kind == ENGINE_GRAPH_EXPORT)
                result = describe(graph, pass, command);
    }
    return result;
}

static bool has_executed(const lobe_graph *graph) {
    return graph->frame.result == LOBE_OK && (graph->frame.phase == ENGINE_GRAPH_SUBMITTED ||
                                              graph->frame.phase == ENGINE_GRAPH_EXECUTED);
}

const lobe_vulkan_descriptor *lobe_graph_exported(const lobe_graph *graph, size_t index,
                                                  size_t *count) {
    if (!graph || !count || !has_executed(graph))
        return NULL;
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++)
        for (const engine_graph_command *command = graph->frame.passes[i]->first_command; command;
             command = command->next) {
            if (command->kind != ENGINE_GRAPH_EXPORT || index-- > 0)
                continue;
            *count = command->exported_count;
            return command->exported;
        }
    return NULL;
}
