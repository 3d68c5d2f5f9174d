#include "engine/graph/declare/declare.h"

#include <string.h>

static engine_stamp sign_sampler(engine_stamp stamp, const lobe_sampler *sampler) {
    const uint32_t modes[] = {sampler->texels, sampler->levels, sampler->wrap_u, sampler->wrap_v};
    stamp = engine_stamp_bytes(stamp, modes, sizeof modes);
    return engine_stamp_bytes(stamp, &sampler->maximum_anisotropy,
                              sizeof sampler->maximum_anisotropy);
}

static engine_stamp sign_bindings(engine_stamp stamp, const engine_graph_binding_list *list) {
    for (const engine_graph_binding *binding = list->first; binding; binding = binding->next) {
        stamp = engine_stamp_text(stamp, binding->name);
        stamp = sign_sampler(stamp, &binding->sampler);
    }
    return stamp;
}

static engine_stamp sign_specialisation(engine_stamp stamp, const lobe_specialisation *values,
                                        size_t count) {
    stamp = engine_stamp_mix(stamp, count);
    for (size_t i = 0; i < count; i++)
        stamp = engine_stamp_mix(engine_stamp_mix(stamp, values[i].id), values[i].bits);
    return stamp;
}

static engine_stamp sign_dispatch(engine_stamp stamp, const lobe_dispatch *dispatch) {
    stamp = engine_stamp_bytes(stamp, dispatch->threads, sizeof dispatch->threads);
    stamp = engine_stamp_bytes(stamp, dispatch->constants, dispatch->constants_size);
    return sign_specialisation(stamp, dispatch->specialisation, dispatch->specialisation_count);
}

static engine_stamp sign_draw(engine_stamp stamp, const lobe_draw *draw) {
    const uint32_t numbers[] = {draw->first_index,
                                draw->index_count,
                                draw->instance_count,
                                draw->indices.version != 0,
                                draw->fragment_shader != NULL,
                                draw->cull,
                                draw->depth_test,
                                draw->depth_write,
                                draw->depth_equal,
                                draw->blend};
    stamp = engine_stamp_bytes(stamp, numbers, sizeof numbers);
    stamp = engine_stamp_bytes(stamp, draw->constants, draw->constants_size);
    return sign_specialisation(stamp, draw->specialisation, draw->specialisation_count);
}

static engine_stamp sign_command(engine_stamp stamp, const engine_graph_command *command) {
    stamp = engine_stamp_mix(stamp, command->kind);
    stamp = engine_stamp_mix(stamp, command->shader_stamp);
    stamp = sign_bindings(stamp, &command->bindings);
    stamp = engine_stamp_bytes(stamp, command->value, sizeof command->value);
    stamp = engine_stamp_bytes(stamp, &command->part, sizeof command->part);
    stamp = engine_stamp_mix(engine_stamp_mix(stamp, command->target_x), command->target_y);
    stamp = engine_stamp_mix(stamp, command->indirect_access != ENGINE_DEPENDENCY_NONE);
    stamp = engine_stamp_mix(stamp, command->indirect_offset);
    if (command->kind == ENGINE_GRAPH_DISPATCH)
        return sign_dispatch(stamp, &command->dispatch);
    return command->kind == ENGINE_GRAPH_DRAW ? sign_draw(stamp, &command->draw) : stamp;
}

static engine_stamp sign_attachment(engine_stamp stamp, const engine_graph_attachment *attachment) {
    if (attachment->access == ENGINE_DEPENDENCY_NONE)
        return engine_stamp_mix(stamp, 0);
    stamp = engine_stamp_mix(stamp, 1 + (uint64_t)attachment->load);
    return engine_stamp_bytes(stamp, attachment->clear, sizeof attachment->clear);
}

static engine_stamp sign_attachments(engine_stamp stamp, const lobe_pass *pass) {
    for (uint32_t i = 0; i < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS; i++) {
        stamp = sign_attachment(stamp, &pass->colour[i]);
        stamp = sign_attachment(stamp, &pass->resolve[i]);
    }
    return sign_attachment(stamp, &pass->depth);
}

static engine_stamp sign_pass(const lobe_pass *pass) {
    engine_stamp stamp =
        engine_stamp_text(engine_stamp_mix(ENGINE_STAMP_NONE, pass->kind), pass->name);
    stamp = sign_bindings(stamp, &pass->bindings);
    if (pass->kind == LOBE_PASS_RASTER)
        stamp = sign_attachments(stamp, pass);
    for (const engine_graph_command *command = pass->first_command; command;
         command = command->next)
        stamp = sign_command(stamp, command);
    return stamp;
}

lobe_result engine_graph_sign_passes(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++)
        graph->frame.dependencies.passes[i].signature = sign_pass(graph->frame.passes[i]);
    return LOBE_OK;
}

static bool set_number(const engine_dependency_graph *dependencies,
                       const engine_graph_command *command) {
    if (!command->number)
        return false;
    const engine_stamp wide = dependencies->resources[command->dispatch.numbered.index].number;
    const uint32_t folded = (uint32_t)(wide ^ wide >> 32), number = folded > 0 ? folded : 1;
    memcpy(command->number, &number, sizeof number);
    return true;
}

void engine_graph_number_content(lobe_graph *graph) {
    engine_dependency_graph *dependencies = &graph->frame.dependencies;
    if (!dependencies->numbers)
        return;
    engine_dependency_number(dependencies);
    for (uint32_t i = 0; i < dependencies->pass_count; i++) {
        const lobe_pass *pass = graph->frame.passes[i];
        bool numbered = false;
        for (const engine_graph_command *command = pass->first_command; command;
             command = command->next)
            numbered |= set_number(dependencies, command);
        if (numbered)
            dependencies->passes[i].signature = sign_pass(pass);
    }
}
