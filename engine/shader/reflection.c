#include "engine/shader/reflection.h"

#include <stdlib.h>
#include <string.h>

#include <spirv_cross/spirv_cross_c.h>

typedef struct reflection {
    const lobe_host *host;
    engine_shader *shader;
    spvc_context context;
    spvc_compiler compiler;
    spvc_set active; ///< variables that the entry point refers to
} reflection;

static lobe_result fail_spirv(const reflection *reflection) {
    return lobe_host_fail(reflection->host, LOBE_ERROR_SHADER, "shader '%s': %s",
                          reflection->shader->name,
                          spvc_context_get_last_error_string(reflection->context));
}

static lobe_result fail_memory(const reflection *reflection) {
    return lobe_host_fail(reflection->host, LOBE_ERROR_OUT_OF_MEMORY, "shader '%s': out of memory",
                          reflection->shader->name);
}

static lobe_result parse(reflection *reflection, const uint32_t *words, size_t count) {
    spvc_parsed_ir parsed = NULL;
    if (spvc_context_parse_spirv(reflection->context, words, count, &parsed) != SPVC_SUCCESS ||
        spvc_context_create_compiler(reflection->context, SPVC_BACKEND_NONE, parsed,
                                     SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                     &reflection->compiler) != SPVC_SUCCESS ||
        spvc_compiler_get_active_interface_variables(reflection->compiler, &reflection->active) !=
            SPVC_SUCCESS)
        return fail_spirv(reflection);
    return LOBE_OK;
}

static lobe_result reflect_stage(reflection *reflection) {
    switch (spvc_compiler_get_execution_model(reflection->compiler)) {
    case SpvExecutionModelVertex:
        reflection->shader->stage = VK_SHADER_STAGE_VERTEX_BIT;
        return LOBE_OK;
    case SpvExecutionModelFragment:
        reflection->shader->stage = VK_SHADER_STAGE_FRAGMENT_BIT;
        return LOBE_OK;
    case SpvExecutionModelGLCompute:
        reflection->shader->stage = VK_SHADER_STAGE_COMPUTE_BIT;
        return LOBE_OK;
    default:
        return lobe_host_fail(
            reflection->host, LOBE_ERROR_SHADER,
            "shader '%s': only vertex, fragment and compute shaders are supported",
            reflection->shader->name);
    }
}

// ---------------------------------------------------------------------------------------------
// Bindings

static VkImageViewType view_of(spvc_type type) {
    const bool arrayed = spvc_type_get_image_arrayed(type);
    switch (spvc_type_get_image_dimension(type)) {
    case SpvDimCube:
        return arrayed ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE;
    case SpvDim3D:
        return VK_IMAGE_VIEW_TYPE_3D;
    default:
        return arrayed ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    }
}

static lobe_format format_of(SpvImageFormat format) {
    switch (format) {
    case SpvImageFormatR8:
        return LOBE_FORMAT_R8_UNORM;
    case SpvImageFormatRg8:
        return LOBE_FORMAT_RG8_UNORM;
    case SpvImageFormatRg8Snorm:
        return LOBE_FORMAT_RG8_SNORM;
    case SpvImageFormatRgba8Snorm:
        return LOBE_FORMAT_RGBA8_SNORM;
    case SpvImageFormatRg16:
        return LOBE_FORMAT_RG16_UNORM;
    case SpvImageFormatRg16Snorm:
        return LOBE_FORMAT_RG16_SNORM;
    case SpvImageFormatRgba8:
        return LOBE_FORMAT_RGBA8_UNORM;
    case SpvImageFormatRgba16:
        return LOBE_FORMAT_RGBA16_UNORM;
    case SpvImageFormatRgba16Snorm:
        return LOBE_FORMAT_RGBA16_SNORM;
    case SpvImageFormatR16f:
        return LOBE_FORMAT_R16_FLOAT;
    case SpvImageFormatRg16f:
        return LOBE_FORMAT_RG16_FLOAT;
    case SpvImageFormatRgba16f:
        return LOBE_FORMAT_RGBA16_FLOAT;
    case SpvImageFormatR32f:
        return LOBE_FORMAT_R32_FLOAT;
    case SpvImageFormatRg32f:
        return LOBE_FORMAT_RG32_FLOAT;
    case SpvImageFormatRgba32f:
        return LOBE_FORMAT_RGBA32_FLOAT;
    default:
        return LOBE_FORMAT_NONE;
    }
}

/// In blocks, `readonly` and `writeonly` are decorations of every member.
static bool block_is_decorated(const reflection *reflection,
                               const spvc_reflected_resource *resource, SpvDecoration decoration) {
    const SpvDecoration *decorations = NULL;
    size_t count = 0;
    if (spvc_compiler_get_buffer_block_decorations(reflection->compiler, resource->id, &decorations,
                                                   &count) != SPVC_SUCCESS)
        return false;
    for (size_t i = 0; i < count; i++)
        if (decorations[i] == decoration)
            return true;
    return false;
}

static bool is_decorated(const reflection *reflection, const spvc_reflected_resource *resource,
                         VkDescriptorType type, SpvDecoration decoration) {
    return type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
               ? block_is_decorated(reflection, resource, decoration)
               : spvc_compiler_has_decoration(reflection->compiler, resource->id, decoration);
}

static void reflect_access(const reflection *reflection, const spvc_reflected_resource *resource,
                           engine_shader_binding *binding) {
    const VkDescriptorType type = binding->type;
    const bool storage =
        type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER || type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    binding->reads =
        !storage || !is_decorated(reflection, resource, type, SpvDecorationNonReadable);
    binding->writes =
        storage && !is_decorated(reflection, resource, type, SpvDecorationNonWritable);
}

static uint32_t array_count(spvc_type type) {
    return spvc_type_get_num_array_dimensions(type) ? spvc_type_get_array_dimension(type, 0) : 1;
}

static void reflect_type(const reflection *reflection, const spvc_reflected_resource *resource,
                         engine_shader_binding *binding) {
    spvc_type type = spvc_compiler_get_type_handle(reflection->compiler, resource->type_id);
    binding->count = array_count(type);
    if (binding->type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
        binding->type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
        spvc_type block =
            spvc_compiler_get_type_handle(reflection->compiler, resource->base_type_id);
        // A block that holds only a runtime array has no fixed size: it stays 0.
        spvc_compiler_get_declared_struct_size(reflection->compiler, block, &binding->size);
        return;
    }
    binding->view = view_of(type);
    binding->multisampled = spvc_type_get_image_multisampled(type);
    if (binding->type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE)
        binding->format = format_of(spvc_type_get_image_storage_format(type));
}

static bool contains(const spvc_reflected_resource *resources, size_t count, spvc_variable_id id) {
    for (size_t i = 0; i < count; i++)
        if (resources[i].id == id)
            return true;
    return false;
}

static lobe_result reflect_binding(const reflection *reflection,
                                   const spvc_reflected_resource *resource, VkDescriptorType type,
                                   bool used, engine_shader_binding *binding) {
    const engine_shader *shader = reflection->shader;
    if (spvc_compiler_get_decoration(reflection->compiler, resource->id,
                                     SpvDecorationDescriptorSet) != 0)
        return lobe_host_fail(reflection->host, LOBE_ERROR_SHADER,
                              "shader '%s': '%s' is not in descriptor set 0", shader->name,
                              resource->name);
    char *name = lobe_copy_text(reflection->host->allocator, resource->name);
    if (!name)
        return fail_memory(reflection);
    *binding = (engine_shader_binding){
        .name = name,
        .binding =
            spvc_compiler_get_decoration(reflection->compiler, resource->id, SpvDecorationBinding),
        .type = type,
        .stages = shader->stage,
        .used = used,
    };
    reflect_type(reflection, resource, binding);
    reflect_access(reflection, resource, binding);
    return LOBE_OK;
}

static lobe_result reflect_bindings_of(const reflection *reflection, spvc_resources all,
                                       spvc_resources active, spvc_resource_type resource_type,
                                       VkDescriptorType type) {
    const spvc_reflected_resource *found = NULL, *used = NULL;
    size_t found_count = 0, used_count = 0;
    spvc_resources_get_resource_list_for_type(all, resource_type, &found, &found_count);
    spvc_resources_get_resource_list_for_type(active, resource_type, &used, &used_count);
    if (found_count == 0)
        return LOBE_OK;
    engine_shader *shader = reflection->shader;
    engine_shader_binding *bindings =
        lobe_reallocate(reflection->host->allocator, shader->bindings,
                        shader->binding_count + found_count, sizeof *shader->bindings);
    if (!bindings)
        return fail_memory(reflection);
    shader->bindings = bindings;
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < found_count; i++) {
        result =
            reflect_binding(reflection, &found[i], type, contains(used, used_count, found[i].id),
                            &bindings[shader->binding_count]);
        shader->binding_count += result == LOBE_OK;
    }
    return result;
}

static lobe_result refuse_resource(const reflection *reflection,
                                   const spvc_reflected_resource *resource, const char *kind) {
    return lobe_host_fail(reflection->host, LOBE_ERROR_SHADER,
                          "shader '%s': '%s' is a %s, which lobe does not use",
                          reflection->shader->name, resource->name, kind);
}

static lobe_result refuse(const reflection *reflection, spvc_resources all, spvc_resource_type type,
                          const char *kind) {
    const spvc_reflected_resource *found = NULL;
    size_t count = 0;
    spvc_resources_get_resource_list_for_type(all, type, &found, &count);
    return count == 0 ? LOBE_OK : refuse_resource(reflection, &found[0], kind);
}

/// Reflection counts them as images without a sampler.
static lobe_result refuse_texel_buffers(const reflection *reflection, spvc_resources all) {
    const spvc_reflected_resource *found = NULL;
    size_t count = 0;
    spvc_resources_get_resource_list_for_type(all, SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, &found,
                                              &count);
    for (size_t i = 0; i < count; i++) {
        spvc_type type = spvc_compiler_get_type_handle(reflection->compiler, found[i].type_id);
        if (spvc_type_get_image_dimension(type) == SpvDimBuffer)
            return refuse_resource(reflection, &found[i], "texel buffer");
    }
    return LOBE_OK;
}

static int order_by_binding(const void *first, const void *second) {
    const uint32_t a = ((const engine_shader_binding *)first)->binding;
    const uint32_t b = ((const engine_shader_binding *)second)->binding;
    return (a > b) - (a < b);
}

static lobe_result reflect_bindings(const reflection *reflection, spvc_resources all,
                                    spvc_resources active) {
    static const struct {
        spvc_resource_type resource;
        VkDescriptorType descriptor;
    } kinds[] = {
        {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
        {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
        {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
        {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
    };
    lobe_result result = refuse_texel_buffers(reflection, all);
    if (result == LOBE_OK)
        result = refuse(reflection, all, SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, "separate sampler");
    for (size_t i = 0; result == LOBE_OK && i < sizeof kinds / sizeof *kinds; i++)
        result =
            reflect_bindings_of(reflection, all, active, kinds[i].resource, kinds[i].descriptor);
    engine_shader *shader = reflection->shader;
    if (shader->binding_count)
        qsort(shader->bindings, shader->binding_count, sizeof *shader->bindings, order_by_binding);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Everything else

static void reflect_push_constants(const reflection *reflection, spvc_resources all) {
    const spvc_reflected_resource *found = NULL;
    size_t count = 0, size = 0;
    spvc_resources_get_resource_list_for_type(all, SPVC_RESOURCE_TYPE_PUSH_CONSTANT, &found,
                                              &count);
    if (count == 0)
        return;
    spvc_type block = spvc_compiler_get_type_handle(reflection->compiler, found[0].base_type_id);
    spvc_compiler_get_declared_struct_size(reflection->compiler, block, &size);
    reflection->shader->push_constant_size = (uint32_t)size;
}

static void reflect_outputs(const reflection *reflection, spvc_resources active) {
    const spvc_reflected_resource *found = NULL;
    size_t count = 0;
    if (reflection->shader->stage != VK_SHADER_STAGE_FRAGMENT_BIT)
        return;
    spvc_resources_get_resource_list_for_type(active, SPVC_RESOURCE_TYPE_STAGE_OUTPUT, &found,
                                              &count);
    for (size_t i = 0; i < count; i++)
        reflection->shader->output_locations |=
            1u << (31 & spvc_compiler_get_decoration(reflection->compiler, found[i].id,
                                                     SpvDecorationLocation));
}

static void reflect_local_size(const reflection *reflection) {
    engine_shader *shader = reflection->shader;
    if (shader->stage != VK_SHADER_STAGE_COMPUTE_BIT)
        return;
    spvc_specialization_constant ids[3];
    spvc_compiler_get_work_group_size_specialization_constants(reflection->compiler, &ids[0],
                                                               &ids[1], &ids[2]);
    for (unsigned i = 0; i < 3; i++) {
        shader->local_size[i] = spvc_compiler_get_execution_mode_argument_by_index(
            reflection->compiler, SpvExecutionModeLocalSize, i);
        shader->local_size_ids[i] = ids[i].id ? ids[i].constant_id : UINT32_MAX;
    }
}

static lobe_result reflect_specialisation(const reflection *reflection) {
    const spvc_specialization_constant *found = NULL;
    size_t count = 0;
    if (spvc_compiler_get_specialization_constants(reflection->compiler, &found, &count) !=
        SPVC_SUCCESS)
        return fail_spirv(reflection);
    if (count == 0)
        return LOBE_OK;
    engine_shader *shader = reflection->shader;
    shader->specialisation_ids =
        lobe_allocate(reflection->host->allocator, count, sizeof *shader->specialisation_ids);
    if (!shader->specialisation_ids)
        return fail_memory(reflection);
    shader->specialisation_count = count;
    for (size_t i = 0; i < count; i++)
        shader->specialisation_ids[i] = found[i].constant_id;
    return LOBE_OK;
}

static lobe_result reflect_resources(const reflection *reflection) {
    spvc_resources all = NULL, active = NULL;
    if (spvc_compiler_create_shader_resources(reflection->compiler, &all) != SPVC_SUCCESS ||
        spvc_compiler_create_shader_resources_for_active_variables(
            reflection->compiler, &active, reflection->active) != SPVC_SUCCESS)
        return fail_spirv(reflection);
    reflect_push_constants(reflection, all);
    reflect_outputs(reflection, active);
    return reflect_bindings(reflection, all, active);
}

lobe_result engine_reflect(const lobe_host *host, const uint32_t *words, size_t word_count,
                           engine_shader *shader) {
    reflection reflection = {.host = host, .shader = shader};
    if (spvc_context_create(&reflection.context) != SPVC_SUCCESS)
        return fail_memory(&reflection);
    lobe_result result = parse(&reflection, words, word_count);
    if (result == LOBE_OK)
        result = reflect_stage(&reflection);
    if (result == LOBE_OK)
        result = reflect_resources(&reflection);
    if (result == LOBE_OK)
        result = reflect_specialisation(&reflection);
    if (result == LOBE_OK)
        reflect_local_size(&reflection);
    spvc_context_destroy(reflection.context);
    return result;
}

void engine_reflection_free(engine_shader *shader) {
    for (size_t i = 0; i < shader->binding_count; i++)
        lobe_release((void *)shader->bindings[i].name);
    lobe_release(shader->bindings);
    lobe_release(shader->specialisation_ids);
    shader->bindings = NULL;
    shader->specialisation_ids = NULL;
    shader->binding_count = shader->specialisation_count = 0;
}
