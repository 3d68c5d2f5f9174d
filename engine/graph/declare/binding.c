#include "engine/graph/declare/declare.h"

#include <string.h>

#include "engine/pipeline/pipelines.h"
#include "engine/shader/shaders.h"

// ---------------------------------------------------------------------------------------------
// Whether a resource fits a shader's variable

typedef struct binding_site {
    lobe_pass *pass;
    const engine_shader *shader;
    const engine_shader_binding *variable;
    engine_graph_binding *binding;
    engine_dependency_access *access;
    engine_graph_resource *resource;
} binding_site;

static bool mismatch(const binding_site *site, const char *why) {
    lobe_graph_fail(site->pass->graph, LOBE_ERROR_GRAPH,
                    "pass '%s', shader '%s': resource '%s' does not fit binding '%s': %s",
                    site->pass->name, site->shader->name, site->resource->name,
                    site->variable->name, why);
    return false;
}

static bool is_block(const engine_shader_binding *variable) {
    return variable->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
           variable->type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

static bool is_storage(const engine_shader_binding *variable) {
    return variable->type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ||
           variable->type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

static bool check_direction(const binding_site *site) {
    if (site->binding->kind == ENGINE_ACCESS_READ && site->variable->writes)
        return mismatch(site,
                        "the shader may write to it: declare it readonly in the shader, or bind "
                        "it for writing");
    if (site->binding->kind != ENGINE_ACCESS_READ && !site->variable->writes)
        return mismatch(site, "the shader only reads it");
    return true;
}

static bool check_block(const binding_site *site) {
    const VkPhysicalDeviceLimits *limits = &site->pass->graph->device->limits;
    if (site->resource->is_image)
        return mismatch(site, "the shader expects a block of data, not an image");
    if (site->resource->size < site->variable->size)
        return mismatch(site, "the buffer is smaller than the shader's block");
    if (site->variable->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER &&
        site->variable->size > limits->maxUniformBufferRange)
        return mismatch(site, "the block is larger than the device's limit for uniform blocks");
    return true;
}

static bool check_view(const binding_site *site) {
    uint32_t layers = site->access->range.layer_count;
    bool square = site->resource->width == site->resource->height;
    switch (site->variable->view) {
    case VK_IMAGE_VIEW_TYPE_2D:
        return layers == 1 || mismatch(site, "several layers, but the shader expects no array");
    case VK_IMAGE_VIEW_TYPE_2D_ARRAY:
        return true;
    case VK_IMAGE_VIEW_TYPE_CUBE:
        return (square && layers == 6) || mismatch(site, "a cube needs six square layers");
    case VK_IMAGE_VIEW_TYPE_CUBE_ARRAY:
        return (square && layers % 6 == 0) || mismatch(site, "each cube needs six square layers");
    default:
        return mismatch(site, "the shader expects an image that is not two-dimensional");
    }
}

static bool check_sampler(const binding_site *site) {
    const lobe_device *device = site->pass->graph->device;
    const lobe_sampler *sampler = &site->binding->sampler;
    bool linear = sampler->texels == LOBE_SAMPLE_LINEAR || sampler->levels == LOBE_SAMPLE_LINEAR;
    bool wide = site->resource->format == LOBE_FORMAT_R32_FLOAT ||
                site->resource->format == LOBE_FORMAT_RG32_FLOAT ||
                site->resource->format == LOBE_FORMAT_RGBA32_FLOAT;
    if (linear && wide && !device->information.linear_filter_float32)
        return mismatch(site, "the device cannot filter 32-bit float images");
    return true;
}

static bool check_image(const binding_site *site) {
    const engine_shader_binding *variable = site->variable;
    if (!site->resource->is_image)
        return mismatch(site, "the shader expects an image, not a buffer");
    if (variable->multisampled != (site->resource->samples > 1))
        return mismatch(site, "one is multisampled, the other is not");
    if (!check_view(site))
        return false;
    if (variable->type != VK_DESCRIPTOR_TYPE_STORAGE_IMAGE)
        return check_sampler(site);
    if (site->resource->origin == ENGINE_GRAPH_TEXTURE)
        return mismatch(site, "textures can only be sampled, not used as storage images");
    if (site->access->range.level_count != 1)
        return mismatch(site, "a storage image must be a single level");
    if (variable->format != LOBE_FORMAT_NONE && variable->format != site->resource->format)
        return mismatch(site, "the shader declares another format");
    return true;
}

/// Whether it is still there after the frame, and its view too.
static bool check_export(const binding_site *site) {
    if (site->resource->origin == ENGINE_GRAPH_TRANSIENT)
        return mismatch(site, "only retained images can be exported");
    if (site->resource->origin == ENGINE_GRAPH_HOST_IMAGE && !site->resource->host->view)
        return mismatch(site, "a host image must have a view to be exported");
    return true;
}

static bool check_fit(const binding_site *site) {
    if (site->variable->count != 1)
        return mismatch(site, "arrays of bindings are not supported");
    if (site->pass->kind == LOBE_PASS_EXPORT && !check_export(site))
        return false;
    return check_direction(site) &&
           (is_block(site->variable) ? check_block(site) : check_image(site));
}

// ---------------------------------------------------------------------------------------------
// How the resource is used

static uint64_t stages_of(const binding_site *site) {
    // The host has shaders of any stage.
    if (site->pass->kind == LOBE_PASS_EXPORT)
        return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
               VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    switch (site->shader->stage) {
    case VK_SHADER_STAGE_VERTEX_BIT:
        return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    case VK_SHADER_STAGE_FRAGMENT_BIT:
        return VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    default:
        return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    }
}

static engine_layout layout_of(const engine_shader_binding *variable) {
    if (is_block(variable))
        return ENGINE_LAYOUT_UNDEFINED;
    return is_storage(variable) ? ENGINE_LAYOUT_GENERAL : ENGINE_LAYOUT_SAMPLED;
}

static uint64_t access_of(const engine_shader_binding *variable, engine_access_kind kind) {
    if (variable->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)
        return VK_ACCESS_2_UNIFORM_READ_BIT;
    if (layout_of(variable) == ENGINE_LAYOUT_SAMPLED)
        return VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    uint64_t access = kind != ENGINE_ACCESS_READ ? VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT : 0;
    return access | (variable->reads ? VK_ACCESS_2_SHADER_STORAGE_READ_BIT : 0);
}

static VkFlags usage_of(const engine_shader_binding *variable) {
    switch (variable->type) {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
        return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
        return VK_IMAGE_USAGE_STORAGE_BIT;
    default:
        return VK_IMAGE_USAGE_SAMPLED_BIT;
    }
}

static void record_use(const binding_site *site) {
    engine_access_state *state = &site->access->state;
    engine_layout layout = layout_of(site->variable);
    state->stages |= stages_of(site);
    state->access |= access_of(site->variable, site->binding->kind);
    // Both a sampled and a storage image in one pass: one layout must allow both.
    state->layout = state->layout == ENGINE_LAYOUT_UNDEFINED || state->layout == layout
                        ? layout
                        : ENGINE_LAYOUT_GENERAL;
    site->resource->usage |= usage_of(site->variable);
    if (site->variable->view == VK_IMAGE_VIEW_TYPE_CUBE ||
        site->variable->view == VK_IMAGE_VIEW_TYPE_CUBE_ARRAY)
        site->resource->cube = true;
    site->binding->known = true;
}

// ---------------------------------------------------------------------------------------------
// Shaders of a command

static engine_graph_binding *find(const engine_graph_binding_list *list, const char *name) {
    for (engine_graph_binding *binding = list->first; binding; binding = binding->next)
        if (strcmp(binding->name, name) == 0)
            return binding;
    return NULL;
}

engine_graph_binding *engine_graph_find_binding(const lobe_pass *pass,
                                                const engine_graph_command *command,
                                                const char *name) {
    engine_graph_binding *own = find(&command->bindings, name);
    return own ? own : find(&pass->bindings, name);
}

static bool resolve_variable(lobe_pass *pass, engine_graph_command *command,
                             const engine_shader *shader, const engine_shader_binding *variable) {
    lobe_graph *graph = pass->graph;
    engine_graph_binding *binding = engine_graph_find_binding(pass, command, variable->name);
    if (!binding && !variable->used)
        return true;
    if (!binding) {
        lobe_graph_fail(graph, LOBE_ERROR_GRAPH, "pass '%s', shader '%s': nothing is bound to '%s'",
                        pass->name, shader->name, variable->name);
        return false;
    }
    engine_dependency_access *access = &graph->frame.dependencies.accesses[binding->access];
    binding_site site = {.pass = pass,
                         .shader = shader,
                         .variable = variable,
                         .binding = binding,
                         .access = access,
                         .resource = &graph->frame.resources[access->resource]};
    if (!check_fit(&site))
        return false;
    record_use(&site);
    return true;
}

static bool resolve_shader(lobe_pass *pass, engine_graph_command *command, const char *name,
                           uint32_t *push_constant_size) {
    const engine_shader *shader = NULL;
    lobe_result result = engine_shader_find(pass->graph->device, name, &shader);
    if (result != LOBE_OK) {
        engine_graph_propagate(pass->graph, result);
        return false;
    }
    if (shader->push_constant_size > *push_constant_size)
        *push_constant_size = shader->push_constant_size;
    command->shader_stamp = engine_stamp_mix(command->shader_stamp, shader->version);
    for (size_t i = 0; i < shader->binding_count; i++)
        if (!resolve_variable(pass, command, shader, &shader->bindings[i]))
            return false;
    return true;
}

static bool check_constants(lobe_pass *pass, const char *shader, size_t given, uint32_t wanted) {
    if (given != wanted)
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH,
                        "pass '%s', shader '%s': %zu bytes of constants, the shader expects %u",
                        pass->name, shader, given, wanted);
    return given == wanted;
}

static bool check_names(lobe_pass *pass, const engine_graph_binding_list *list,
                        const char *shader) {
    for (const engine_graph_binding *binding = list->first; binding; binding = binding->next)
        if (!binding->known) {
            lobe_graph_fail(
                pass->graph, LOBE_ERROR_GRAPH,
                "pass '%s' binds resource '%s' to '%s', which shader '%s' does not "
                "have",
                pass->name,
                pass->graph->frame
                    .resources[pass->graph->frame.dependencies.accesses[binding->access].resource]
                    .name,
                binding->name, shader);
            return false;
        }
    return true;
}

static bool resolve_dispatch(lobe_pass *pass, engine_graph_command *command) {
    const lobe_dispatch *dispatch = &command->dispatch;
    uint32_t constants = 0;
    return resolve_shader(pass, command, dispatch->shader, &constants) &&
           check_constants(pass, dispatch->shader, dispatch->constants_size, constants) &&
           check_names(pass, &command->bindings, dispatch->shader);
}

static bool resolve_draw(lobe_pass *pass, engine_graph_command *command) {
    const lobe_draw *draw = &command->draw;
    uint32_t constants = 0;
    if (!resolve_shader(pass, command, draw->vertex_shader, &constants))
        return false;
    if (draw->fragment_shader && !resolve_shader(pass, command, draw->fragment_shader, &constants))
        return false;
    return check_constants(pass, draw->vertex_shader, draw->constants_size, constants) &&
           check_names(pass, &command->bindings, draw->vertex_shader);
}

/// Of the shader's variables, only those that something is bound to are exported.
static bool resolve_export(lobe_pass *pass, engine_graph_command *command) {
    const engine_shader *shader = NULL;
    lobe_result result = engine_shader_find(pass->graph->device, command->export_shader, &shader);
    if (result != LOBE_OK) {
        engine_graph_propagate(pass->graph, result);
        return false;
    }
    for (size_t i = 0; i < shader->binding_count; i++)
        if (engine_graph_find_binding(pass, command, shader->bindings[i].name) &&
            !resolve_variable(pass, command, shader, &shader->bindings[i]))
            return false;
    return check_names(pass, &command->bindings, command->export_shader);
}

static const char *last_shader(const lobe_pass *pass) {
    const engine_graph_command *command = pass->last_command;
    if (!command)
        return "(none)";
    if (command->kind == ENGINE_GRAPH_DISPATCH)
        return command->dispatch.shader;
    if (command->kind == ENGINE_GRAPH_EXPORT)
        return command->export_shader;
    return command->draw.fragment_shader ? command->draw.fragment_shader
                                         : command->draw.vertex_shader;
}

static bool resolve_pass(lobe_pass *pass) {
    if (pass->kind == LOBE_PASS_COMPUTE && !pass->first_command) {
        lobe_graph_fail(pass->graph, LOBE_ERROR_GRAPH, "compute pass '%s' has no dispatch",
                        pass->name);
        return false;
    }
    for (engine_graph_command *command = pass->first_command; command; command = command->next) {
        if (command->kind == ENGINE_GRAPH_DISPATCH && !resolve_dispatch(pass, command))
            return false;
        if (command->kind == ENGINE_GRAPH_DRAW && !resolve_draw(pass, command))
            return false;
        if (command->kind == ENGINE_GRAPH_EXPORT && !resolve_export(pass, command))
            return false;
    }
    return check_names(pass, &pass->bindings, last_shader(pass));
}

lobe_result engine_graph_resolve_bindings(lobe_graph *graph) {
    for (uint32_t i = 0; i < graph->frame.dependencies.pass_count; i++)
        if (!resolve_pass(graph->frame.passes[i]))
            return graph->frame.result;
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Pipelines

static lobe_result count_groups(lobe_pass *pass, engine_graph_command *command) {
    const VkPhysicalDeviceLimits *limits = &pass->graph->device->limits;
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t threads = command->dispatch.threads[i] ? command->dispatch.threads[i] : 1;
        uint32_t local = command->pipeline->local_size[i];
        command->group_count[i] = threads / local + (threads % local != 0);
        if (command->group_count[i] > limits->maxComputeWorkGroupCount[i])
            return lobe_graph_fail(pass->graph, LOBE_ERROR_LIMIT,
                                   "pass '%s', shader '%s': %u groups, the device's limit is %u",
                                   pass->name, command->dispatch.shader, command->group_count[i],
                                   limits->maxComputeWorkGroupCount[i]);
    }
    return LOBE_OK;
}

static lobe_result find_pipeline(lobe_pass *pass, engine_graph_command *command) {
    lobe_device *device = pass->graph->device;
    if (command->kind == ENGINE_GRAPH_DISPATCH) {
        engine_compute_parameters parameters = {.shader = command->dispatch.shader,
                                                .specialisation = command->dispatch.specialisation,
                                                .specialisation_count =
                                                    command->dispatch.specialisation_count};
        lobe_result result = engine_pipeline_compute(device, &parameters, &command->pipeline);
        return result == LOBE_OK ? count_groups(pass, command) : result;
    }
    if (command->kind != ENGINE_GRAPH_DRAW)
        return LOBE_OK;
    engine_raster_parameters parameters = engine_graph_raster_parameters(pass, &command->draw);
    return engine_pipeline_raster(device, &parameters, &command->pipeline);
}

static uint32_t count_commands(const lobe_graph *graph) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < graph->frame.dependencies.running_count; i++) {
        const lobe_pass *pass = graph->frame.passes[graph->frame.dependencies.running[i]];
        for (const engine_graph_command *command = pass->first_command; command;
             command = command->next)
            ++count;
    }
    return count;
}

lobe_result engine_graph_prepare_pipelines(lobe_graph *graph,
                                           bool (*progress)(void *user, double part), void *user) {
    const uint32_t count = progress ? count_commands(graph) : 0;
    uint32_t done = 0;
    engine_pipelines_begin_use(graph->device, &graph->frame.flight->pipelines);
    for (uint32_t i = 0; i < graph->frame.dependencies.running_count; i++) {
        lobe_pass *pass = graph->frame.passes[graph->frame.dependencies.running[i]];
        for (engine_graph_command *command = pass->first_command; command;
             command = command->next) {
            lobe_result result = find_pipeline(pass, command);
            if (result != LOBE_OK)
                return engine_graph_propagate(graph, result);
            if (progress && !progress(user, ++done / (double)count))
                return LOBE_OK;
        }
    }
    return LOBE_OK;
}

lobe_result engine_graph_find_pipelines(lobe_graph *graph) {
    return engine_graph_prepare_pipelines(graph, NULL, NULL);
}
