#include "engine/graph/declare/declare.h"

#include <string.h>

#include "engine/base/growing_array.h"

static const char *const kind_names[] = {
    [LOBE_PASS_COMPUTE] = "compute",
    [LOBE_PASS_RASTER] = "raster",
    [LOBE_PASS_TRANSFER] = "transfer",
    [LOBE_PASS_EXPORT] = "export",
};

// ---------------------------------------------------------------------------------------------
// Passes

lobe_pass *engine_graph_add_pass(lobe_graph *graph, lobe_pass_kind kind, const char *name) {
    lobe_pass *pass = engine_arena_allocate(&graph->frame.arena, sizeof *pass);
    const char *kept = engine_arena_copy_text(&graph->frame.arena, name);
    uint32_t index = graph->frame.dependencies.pass_count;
    if (!pass || !kept ||
        !engine_array_reserve(graph->device->host.allocator, (void **)&graph->frame.passes,
                              &graph->frame.pass_capacity, (uint64_t)index + 1,
                              sizeof *graph->frame.passes) ||
        engine_dependency_add_pass(&graph->frame.dependencies, kept) == ENGINE_DEPENDENCY_NONE) {
        engine_graph_fail_memory(graph);
        return NULL;
    }
    *pass = (lobe_pass){.graph = graph, .index = index, .kind = kind, .name = kept};
    for (uint32_t i = 0; i < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS; i++)
        pass->colour[i].access = pass->resolve[i].access = ENGINE_DEPENDENCY_NONE;
    pass->depth.access = ENGINE_DEPENDENCY_NONE;
    graph->frame.passes[index] = pass;
    return pass;
}

lobe_pass *lobe_graph_add_pass(lobe_graph *graph, lobe_pass_kind kind, const char *name) {
    const char *given = name ? name : "pass";
    lobe_pass *pass = NULL;
    if (engine_graph_can_declare(graph, given))
        pass = engine_graph_add_pass(graph, kind, given);
    if (pass || !graph)
        return pass;
    return &graph->frame.nothing;
}

void lobe_pass_keep(lobe_pass *pass) {
    if (pass && engine_graph_can_declare(pass->graph, pass->name))
        pass->graph->frame.dependencies.passes[pass->index].keep = true;
}

bool engine_graph_check_pass_kind(lobe_pass *pass, lobe_pass_kind kind, const char *call,
                                  const void *argument) {
    if (!pass || !engine_graph_can_declare(pass->graph, pass->name))
        return false;
    if (!argument) {
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "pass '%s': %s is NULL", pass->name, call);
        return false;
    }
    if (pass->kind != kind)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': %s needs a %s pass, this is a %s pass", pass->name, call,
                        kind_names[kind], kind_names[pass->kind]);
    return pass->kind == kind;
}

// ---------------------------------------------------------------------------------------------
// Accesses and bindings

engine_graph_resource *engine_graph_find_resource(lobe_pass *pass, lobe_resource handle) {
    lobe_graph *graph = pass->graph;
    if (handle.version != 0 && handle.index < graph->frame.dependencies.resource_count)
        return &graph->frame.resources[handle.index];
    lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                    "pass '%s' uses a resource handle that is not of this frame", pass->name);
    return NULL;
}

uint32_t engine_graph_add_access(lobe_pass *pass, lobe_resource *resource, lobe_range range,
                                 engine_access_kind kind, engine_access_state state) {
    lobe_graph *graph = pass->graph;
    uint32_t version = 0;
    uint32_t access = engine_dependency_add_access(&graph->frame.dependencies, pass->index,
                                                   *resource, range, kind, &version);
    if (access == ENGINE_DEPENDENCY_NONE) {
        engine_graph_fail_dependency(graph);
        return access;
    }
    graph->frame.dependencies.accesses[access].state = state;
    if (kind != ENGINE_ACCESS_READ)
        resource->version = version;
    return access;
}

static bool is_bound(const engine_graph_binding_list *list, const char *name) {
    for (const engine_graph_binding *bound = list->first; bound; bound = bound->next)
        if (strcmp(bound->name, name) == 0)
            return true;
    return false;
}

static bool check_binding_name(lobe_pass *pass, const engine_graph_binding_list *list,
                               const char *name) {
    if (!name)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "pass '%s': a binding has no name",
                        pass->name);
    else if (is_bound(list, name))
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "pass '%s' binds '%s' twice", pass->name,
                        name);
    return pass->graph->frame.result == LOBE_OK;
}

static void append_binding(engine_graph_binding_list *list, engine_graph_binding *binding) {
    if (list->last)
        list->last->next = binding;
    else
        list->first = binding;
    list->last = binding;
}

/// Copies a binding and adds its access. Returns the resource's newest version.
static lobe_resource add_binding(lobe_pass *pass, engine_graph_binding_list *list,
                                 const lobe_binding *binding, engine_access_kind kind) {
    lobe_graph *graph = pass->graph;
    lobe_resource resource = binding->resource;
    if (!check_binding_name(pass, list, binding->name))
        return resource;
    if (!engine_graph_find_resource(pass, resource))
        return resource;
    if (pass->kind == LOBE_PASS_EXPORT && !graph->frame.resources[resource.index].is_image)
        resource = engine_graph_export_buffer(pass, binding->name, resource);
    if (graph->frame.result != LOBE_OK)
        return resource;
    lobe_range range =
        graph->frame.resources[resource.index].is_image ? binding->range : (lobe_range){0};
    // The shaders decide how it is used: see engine_graph_resolve_bindings.
    uint32_t access =
        engine_graph_add_access(pass, &resource, range, kind, (engine_access_state){0});
    engine_graph_binding *added = engine_arena_allocate(&graph->frame.arena, sizeof *added);
    const char *name = engine_arena_copy_text(&graph->frame.arena, binding->name);
    if (!added || !name) {
        engine_graph_fail_memory(graph);
        return resource;
    }
    *added = (engine_graph_binding){
        .name = name, .sampler = binding->sampler, .kind = kind, .access = access};
    append_binding(list, added);
    return resource;
}

static lobe_resource bind_to_pass(lobe_pass *pass, const lobe_binding *binding,
                                  engine_access_kind kind) {
    if (!pass || !binding) {
        lobe_graph_fail(pass ? pass->graph : NULL, LOBE_ERROR_GRAPH, "pass '%s': a binding is NULL",
                        pass ? pass->name : "");
        return (lobe_resource){0};
    }
    if (!engine_graph_can_declare(pass->graph, pass->name))
        return binding->resource;
    if (pass->kind == LOBE_PASS_TRANSFER) {
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': a transfer pass has no shader to bind '%s' to", pass->name,
                        binding->name ? binding->name : "");
        return binding->resource;
    }
    return add_binding(pass, &pass->bindings, binding, kind);
}

void lobe_pass_read(lobe_pass *pass, const lobe_binding *binding) {
    bind_to_pass(pass, binding, ENGINE_ACCESS_READ);
}

lobe_resource lobe_pass_write(lobe_pass *pass, const lobe_binding *binding) {
    return bind_to_pass(pass, binding, ENGINE_ACCESS_WRITE);
}

lobe_resource lobe_pass_modify(lobe_pass *pass, const lobe_binding *binding) {
    return bind_to_pass(pass, binding, ENGINE_ACCESS_MODIFY);
}

// ---------------------------------------------------------------------------------------------
// Commands

engine_graph_command *engine_graph_add_command(lobe_pass *pass, engine_graph_command_kind kind) {
    engine_graph_command *command =
        engine_arena_allocate(&pass->graph->frame.arena, sizeof *command);
    if (!command) {
        engine_graph_fail_memory(pass->graph);
        return NULL;
    }
    command->kind = kind;
    command->index_access = command->indirect_access = ENGINE_DEPENDENCY_NONE;
    command->source_access = command->target_access = ENGINE_DEPENDENCY_NONE;
    if (pass->last_command)
        pass->last_command->next = command;
    else
        pass->first_command = command;
    pass->last_command = command;
    return command;
}

static bool check_constants(lobe_pass *pass, const char *shader, const void *constants,
                            size_t size) {
    if (!shader) {
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "pass '%s': no shader", pass->name);
    } else if (size > ENGINE_MAXIMUM_PUSH_CONSTANTS || (size > 0 && !constants)) {
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s', shader '%s': %zu bytes of constants, not in [0, %d]",
                        pass->name, shader, size, ENGINE_MAXIMUM_PUSH_CONSTANTS);
    }
    return pass->graph->frame.result == LOBE_OK;
}

void engine_graph_bind_to_command(lobe_pass *pass, engine_graph_command *command,
                                  const lobe_binding *bindings, size_t count) {
    for (size_t i = 0; i < count; i++)
        add_binding(pass, &command->bindings, &bindings[i], ENGINE_ACCESS_READ);
}

/// `size`: of what the command reads at `offset`, bytes.
static void bind_indirect(lobe_pass *pass, engine_graph_command *command, lobe_resource buffer,
                          size_t offset, size_t size) {
    lobe_graph *graph = pass->graph;
    if (buffer.version == 0)
        return;
    engine_graph_resource *arguments = engine_graph_find_resource(pass, buffer);
    if (!arguments)
        return;
    if (arguments->is_image || offset % 4 != 0 || offset > arguments->size ||
        size > arguments->size - offset) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s': no indirect arguments at byte %zu of resource '%s'", pass->name,
                        offset, arguments->name);
        return;
    }
    command->indirect_offset = offset;
    command->indirect_access = engine_graph_add_access(
        pass, &buffer, (lobe_range){0}, ENGINE_ACCESS_READ,
        (engine_access_state){.stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                              .access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
    arguments->usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
}

/// The number that takes the place of one of the constants.
static void want_number(lobe_pass *pass, engine_graph_command *command, char *constants) {
    engine_dependency_graph *dependencies = &pass->graph->frame.dependencies;
    const lobe_dispatch *dispatch = &command->dispatch;
    if (dispatch->numbered.version == 0)
        return;
    const engine_graph_resource *made = engine_graph_find_resource(pass, dispatch->numbered);
    if (!made)
        return;
    uint32_t *numbered_by = &dependencies->resources[dispatch->numbered.index].numbered_by;
    if (dispatch->constants_size < sizeof(uint32_t) ||
        dispatch->number_offset > dispatch->constants_size - sizeof(uint32_t))
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': the number of resource '%s' is to be at byte %zu of %zu",
                        pass->name, made->name, dispatch->number_offset, dispatch->constants_size);
    else if (*numbered_by != ENGINE_DEPENDENCY_NONE)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s': pass '%s' has the number of resource '%s'", pass->name,
                        dependencies->passes[*numbered_by].name, made->name);
    else {
        *numbered_by = pass->index;
        dependencies->numbers = true;
        command->number = constants + dispatch->number_offset;
    }
}

static bool copy_dispatch(lobe_pass *pass, const lobe_dispatch *dispatch,
                          engine_graph_command *command) {
    engine_arena *arena = &pass->graph->frame.arena;
    lobe_dispatch *copy = &command->dispatch;
    *copy = *dispatch;
    copy->shader = engine_arena_copy_text(arena, dispatch->shader);
    char *constants = engine_arena_copy(arena, dispatch->constants, dispatch->constants_size);
    copy->constants = constants;
    copy->specialisation =
        engine_arena_copy(arena, dispatch->specialisation,
                          dispatch->specialisation_count * sizeof *dispatch->specialisation);
    copy->bindings = NULL;
    if (!copy->shader || !constants || !copy->specialisation)
        return false;
    want_number(pass, command, constants);
    return true;
}

void lobe_pass_dispatch(lobe_pass *pass, const lobe_dispatch *dispatch) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_COMPUTE, "a dispatch", dispatch) ||
        !check_constants(pass, dispatch->shader, dispatch->constants, dispatch->constants_size))
        return;
    engine_graph_command *command = engine_graph_add_command(pass, ENGINE_GRAPH_DISPATCH);
    if (!command)
        return;
    if (!copy_dispatch(pass, dispatch, command)) {
        engine_graph_fail_memory(pass->graph);
        return;
    }
    bind_indirect(pass, command, dispatch->indirect, dispatch->indirect_offset,
                  sizeof(lobe_dispatch_arguments));
    engine_graph_bind_to_command(pass, command, dispatch->bindings, dispatch->binding_count);
}

static bool copy_draw(engine_arena *arena, const lobe_draw *draw, lobe_draw *copy) {
    *copy = *draw;
    copy->vertex_shader = engine_arena_copy_text(arena, draw->vertex_shader);
    if (draw->fragment_shader)
        copy->fragment_shader = engine_arena_copy_text(arena, draw->fragment_shader);
    copy->constants = engine_arena_copy(arena, draw->constants, draw->constants_size);
    copy->specialisation = engine_arena_copy(
        arena, draw->specialisation, draw->specialisation_count * sizeof *draw->specialisation);
    copy->bindings = NULL;
    copy->instance_count = draw->instance_count ? draw->instance_count : 1;
    return copy->vertex_shader && (copy->fragment_shader || !draw->fragment_shader) &&
           copy->constants && copy->specialisation;
}

static void bind_indices(lobe_pass *pass, engine_graph_command *command) {
    lobe_draw *draw = &command->draw;
    lobe_graph *graph = pass->graph;
    if (draw->indices.version == 0)
        return;
    const engine_graph_resource *indices = engine_graph_find_resource(pass, draw->indices);
    if (!indices)
        return;
    uint64_t end = ((uint64_t)draw->first_index + draw->index_count) * sizeof(uint32_t);
    if (draw->indirect.version != 0)
        end = 0;
    if (indices->is_image || end > indices->size) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH,
                        "pass '%s' draws indices %u to %llu, which resource '%s' does not hold",
                        pass->name, draw->first_index, (unsigned long long)(end / 4),
                        indices->name);
        return;
    }
    command->index_access =
        engine_graph_add_access(pass, &draw->indices, (lobe_range){0}, ENGINE_ACCESS_READ,
                                (engine_access_state){.stages = VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
                                                      .access = VK_ACCESS_2_INDEX_READ_BIT});
    graph->frame.resources[draw->indices.index].usage |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
}

void lobe_pass_draw(lobe_pass *pass, const lobe_draw *draw) {
    if (!engine_graph_check_pass_kind(pass, LOBE_PASS_RASTER, "a draw", draw) ||
        !check_constants(pass, draw->vertex_shader, draw->constants, draw->constants_size))
        return;
    engine_graph_command *command = engine_graph_add_command(pass, ENGINE_GRAPH_DRAW);
    if (!command)
        return;
    if (!copy_draw(&pass->graph->frame.arena, draw, &command->draw)) {
        engine_graph_fail_memory(pass->graph);
        return;
    }
    bind_indices(pass, command);
    bind_indirect(pass, command, draw->indirect, draw->indirect_offset,
                  sizeof(lobe_draw_arguments));
    engine_graph_bind_to_command(pass, command, draw->bindings, draw->binding_count);
}
