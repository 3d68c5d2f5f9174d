#include "engine/pipeline/pipelines.h"

#include <string.h>

#include "engine/base/growing_array.h"
#include "engine/base/text.h"
#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/pipeline/cache.h"
#include "engine/pipeline/layout.h"
#include "engine/pipeline/module.h"
#include "engine/pipeline/raster.h"
#include "engine/resource/sampler.h"
#include "engine/shader/shaders.h"

#define STATE_WORDS (6 + ENGINE_MAXIMUM_COLOUR_ATTACHMENTS)

/// The key of a pipeline: requests with equal keys share it.
typedef struct pipeline_key {
    const engine_shader *shaders[ENGINE_MAXIMUM_STAGES]; ///< NULL: none
    uint32_t state[STATE_WORDS];                         ///< raster only
    lobe_specialisation *specialisation;                 ///< only constants that the shaders have
    size_t specialisation_count;
} pipeline_key;

typedef struct cached_pipeline {
    struct cached_pipeline *next;
    uint64_t used;      ///< last lookup, by the clock of the uses
    bool in_the_making; ///< by a thread that does not hold the mutex meanwhile
    pipeline_key key;
    engine_pipeline pipeline;
} cached_pipeline;

struct engine_pipelines {
    engine_pipeline_cache cache;
    engine_sampler_cache samplers;
    engine_pipeline_uses uses;
    cached_pipeline *pipelines; ///< most recently used first
    uint32_t count;
    pthread_cond_t made;         ///< one is no longer in the making
    lobe_specialisation *wanted; ///< buffer for the key of the current search
    uint32_t wanted_capacity;
};

// ---------------------------------------------------------------------------------------------
// Keys

static bool has_constant(const pipeline_key *key, uint32_t id) {
    for (size_t i = 0; i < ENGINE_MAXIMUM_STAGES && key->shaders[i]; i++)
        for (size_t j = 0; j < key->shaders[i]->specialisation_count; j++)
            if (key->shaders[i]->specialisation_ids[j] == id)
                return true;
    return false;
}

static void set_constant(pipeline_key *key, lobe_specialisation value) {
    size_t i = 0;
    while (i < key->specialisation_count && key->specialisation[i].id < value.id)
        i++;
    if (i == key->specialisation_count || key->specialisation[i].id != value.id) {
        memmove(&key->specialisation[i + 1], &key->specialisation[i],
                (key->specialisation_count - i) * sizeof *key->specialisation);
        key->specialisation_count++;
    }
    key->specialisation[i] = value;
}

static lobe_result fail_memory(lobe_device *device, const pipeline_key *key) {
    return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY, "pipeline '%s': out of memory",
                          key->shaders[0]->name);
}

/// Sorts the values by id; if an id is repeated, the last value counts.
static lobe_result fill_specialisation(lobe_device *device, const lobe_specialisation *values,
                                       size_t count, pipeline_key *key) {
    engine_pipelines *pipelines = device->pipelines;
    if (!engine_array_reserve(device->host.allocator, (void **)&pipelines->wanted,
                              &pipelines->wanted_capacity, (uint64_t)count + 1,
                              sizeof *pipelines->wanted))
        return fail_memory(device, key);
    key->specialisation = pipelines->wanted;
    for (size_t i = 0; i < count; i++)
        if (has_constant(key, values[i].id))
            set_constant(key, values[i]);
    return LOBE_OK;
}

static uint32_t depth_comparison(const engine_raster_parameters *parameters) {
    return parameters->depth_test ? 1 + parameters->depth_equal : 0;
}

static void fill_state(const engine_raster_parameters *parameters, pipeline_key *key) {
    const uint32_t state[] = {
        parameters->cull,        depth_comparison(parameters),
        parameters->depth_write, parameters->blend,
        parameters->depth,       parameters->samples ? parameters->samples : 1,
    };
    memcpy(key->state, state, sizeof state);
    for (size_t i = 0; i < ENGINE_MAXIMUM_COLOUR_ATTACHMENTS; i++)
        key->state[sizeof state / sizeof *state + i] = parameters->colour[i];
}

static bool same_key(const pipeline_key *first, const pipeline_key *second) {
    return !memcmp(first->shaders, second->shaders, sizeof first->shaders) &&
           !memcmp(first->state, second->state, sizeof first->state) &&
           first->specialisation_count == second->specialisation_count &&
           !memcmp(first->specialisation, second->specialisation,
                   first->specialisation_count * sizeof *first->specialisation);
}

static void put_first(engine_pipelines *pipelines, cached_pipeline *cached) {
    cached->used = pipelines->uses.clock;
    cached->next = pipelines->pipelines;
    pipelines->pipelines = cached;
}

static void take_out(engine_pipelines *pipelines, const cached_pipeline *cached) {
    cached_pipeline **link = &pipelines->pipelines;
    while (*link != cached)
        link = &(*link)->next;
    *link = cached->next;
}

static cached_pipeline *find(engine_pipelines *pipelines, const pipeline_key *key) {
    cached_pipeline *known = pipelines->pipelines;
    while (known && !same_key(&known->key, key))
        known = known->next;
    if (!known)
        return NULL;
    take_out(pipelines, known);
    put_first(pipelines, known);
    return known;
}

static lobe_result find_shader(lobe_device *device, const char *name, VkShaderStageFlagBits stage,
                               const engine_shader **shader) {
    const lobe_result result = engine_shader_find(device, name, shader);
    if (result == LOBE_OK && (*shader)->stage != stage)
        return lobe_host_fail(&device->host, LOBE_ERROR_SHADER, "shader '%s' is for another stage",
                              name);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Creation

static void destroy_pipeline(lobe_device *device, cached_pipeline *cached) {
    device->api.vkDestroyPipeline(device->vulkan, cached->pipeline.pipeline, device->callbacks);
    engine_pipeline_layout_destroy(device, &cached->pipeline);
    lobe_release((void *)cached->pipeline.name);
    lobe_release(cached->key.specialisation);
    lobe_release(cached);
}

static lobe_result check_local_size(lobe_device *device, const engine_pipeline *pipeline) {
    const uint32_t *size = pipeline->local_size, *most = device->limits.maxComputeWorkGroupSize;
    const uint64_t invocations = (uint64_t)size[0] * size[1] * size[2];
    if (size[0] > most[0] || size[1] > most[1] || size[2] > most[2] || invocations == 0 ||
        invocations > device->limits.maxComputeWorkGroupInvocations)
        return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                              "shader '%s': the device does not allow groups of %ux%ux%u",
                              pipeline->name, size[0], size[1], size[2]);
    return LOBE_OK;
}

static lobe_result apply_local_size(lobe_device *device, const pipeline_key *key,
                                    engine_pipeline *pipeline) {
    const engine_shader *shader = key->shaders[0];
    memcpy(pipeline->local_size, shader->local_size, sizeof pipeline->local_size);
    for (size_t i = 0; i < key->specialisation_count; i++)
        for (size_t axis = 0; axis < 3; axis++)
            if (shader->local_size_ids[axis] == key->specialisation[i].id)
                pipeline->local_size[axis] = key->specialisation[i].bits;
    return check_local_size(device, pipeline);
}

static lobe_result create_compute(lobe_device *device, VkPipelineCache cache, VkShaderModule module,
                                  engine_pipeline *pipeline) {
    const VkComputePipelineCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage =
            {
                .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                .module = module,
                .pName = "main",
            },
        .layout = pipeline->layout,
    };
    return VULKAN_CHECK(&device->host,
                        device->api.vkCreateComputePipelines(device->vulkan, cache, 1, &create,
                                                             device->callbacks,
                                                             &pipeline->pipeline),
                        "pipeline '%s'", pipeline->name);
}

static char *name_of(const lobe_allocator *allocator, const pipeline_key *key) {
    const engine_shader *const *shaders = key->shaders;
    return shaders[1] ? engine_text(allocator, "%s + %s", shaders[0]->name, shaders[1]->name)
                      : lobe_copy_text(allocator, shaders[0]->name);
}

static lobe_result create_modules(lobe_device *device, const pipeline_key *key,
                                  VkShaderModule modules[ENGINE_MAXIMUM_STAGES]) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; i < ENGINE_MAXIMUM_STAGES && key->shaders[i] && result == LOBE_OK; i++)
        result = engine_module_create(device, key->shaders[i], key->specialisation,
                                      key->specialisation_count, &modules[i]);
    return result;
}

/// `raster` is NULL for a compute pipeline.
static lobe_result create_vulkan(lobe_device *device, const engine_raster_parameters *raster,
                                 cached_pipeline *cached) {
    engine_pipeline *pipeline = &cached->pipeline;
    const pipeline_key *key = &cached->key;
    const VkPipelineCache cache = device->pipelines->cache.vulkan;
    VkShaderModule modules[ENGINE_MAXIMUM_STAGES] = {VK_NULL_HANDLE};
    lobe_result result =
        engine_pipeline_layout_create(device, key->shaders, key->shaders[1] ? 2 : 1, pipeline);
    if (result == LOBE_OK && !raster)
        result = apply_local_size(device, key, pipeline);
    if (result == LOBE_OK)
        result = create_modules(device, key, modules);
    if (result == LOBE_OK)
        result = raster ? engine_raster_pipeline_create(device, cache, raster, modules[0],
                                                        modules[1], pipeline)
                        : create_compute(device, cache, modules[0], pipeline);
    for (size_t i = 0; i < ENGINE_MAXIMUM_STAGES; i++)
        device->api.vkDestroyShaderModule(device->vulkan, modules[i], device->callbacks);
    if (result == LOBE_OK)
        engine_device_name(device, VK_OBJECT_TYPE_PIPELINE, (uint64_t)pipeline->pipeline,
                           pipeline->name);
    return result;
}

/// Copies a key out of the search buffer; false if out of memory.
static bool keep_key(const lobe_allocator *allocator, const pipeline_key *key, pipeline_key *kept) {
    const size_t size = key->specialisation_count * sizeof *key->specialisation;
    *kept = *key;
    kept->specialisation = lobe_allocate(allocator, size + 1, 1);
    if (kept->specialisation)
        memcpy(kept->specialisation, key->specialisation, size);
    return kept->specialisation != NULL;
}

/// Makes room for one more pipeline as far as frames in progress allow. The list is ordered by last
/// use: everything after the first pipeline that may be destroyed may be destroyed too.
static void evict(lobe_device *device) {
    engine_pipelines *pipelines = device->pipelines;
    if (pipelines->count < ENGINE_MAXIMUM_PIPELINES)
        return;
    const uint64_t oldest =
        engine_pipeline_uses_oldest(&pipelines->uses, engine_device_finished(device));
    cached_pipeline **link = &pipelines->pipelines;
    for (uint32_t n = 1; *link && (n < ENGINE_MAXIMUM_PIPELINES || (*link)->used >= oldest); n++)
        link = &(*link)->next;
    while (*link) {
        cached_pipeline *gone = *link;
        if (gone->in_the_making) {
            link = &gone->next;
            continue;
        }
        *link = gone->next;
        destroy_pipeline(device, gone);
        pipelines->count--;
    }
}

/// Drivers take up to seconds to make a pipeline: meanwhile, other threads find theirs.
static lobe_result make(lobe_device *device, const engine_raster_parameters *raster,
                        cached_pipeline *cached) {
    engine_pipelines *pipelines = device->pipelines;
    pthread_mutex_unlock(&device->found_mutex);
    const lobe_result result = create_vulkan(device, raster, cached);
    pthread_mutex_lock(&device->found_mutex);
    take_out(pipelines, cached);
    cached->in_the_making = false;
    if (result == LOBE_OK) {
        put_first(pipelines, cached);
    } else {
        pipelines->count--;
        destroy_pipeline(device, cached);
    }
    pthread_cond_broadcast(&pipelines->made);
    return result;
}

/// Creates the pipeline for a key.
static lobe_result add(lobe_device *device, const engine_raster_parameters *raster,
                       const pipeline_key *key, const engine_pipeline **pipeline) {
    const lobe_allocator *allocator = device->host.allocator;
    cached_pipeline *cached = lobe_allocate(allocator, 1, sizeof *cached);
    char *name = name_of(allocator, key);
    if (!cached || !name || !keep_key(allocator, key, &cached->key)) {
        lobe_release(cached);
        lobe_release(name);
        return fail_memory(device, key);
    }
    cached->pipeline.name = name;
    cached->pipeline.stamp = engine_device_stamp(device);
    cached->pipeline.bind_point =
        raster ? VK_PIPELINE_BIND_POINT_GRAPHICS : VK_PIPELINE_BIND_POINT_COMPUTE;
    cached->pipeline.output_locations = key->shaders[1] ? key->shaders[1]->output_locations : 0;
    cached->in_the_making = true;
    evict(device);
    put_first(device->pipelines, cached);
    device->pipelines->count++;
    const lobe_result result = make(device, raster, cached);
    *pipeline = result == LOBE_OK ? &cached->pipeline : NULL;
    return result;
}

/// `*waited`: another thread was making the pipeline. The search is to be repeated then: that
/// thread may have failed, and the buffer of the key has changed.
static lobe_result find_or_add(lobe_device *device, const engine_raster_parameters *raster,
                               const pipeline_key *key, const engine_pipeline **pipeline,
                               bool *waited) {
    const cached_pipeline *known = find(device->pipelines, key);
    *waited = known && known->in_the_making;
    if (*waited)
        pthread_cond_wait(&device->pipelines->made, &device->found_mutex);
    else if (known)
        *pipeline = &known->pipeline;
    return known ? LOBE_OK : add(device, raster, key, pipeline);
}

// ---------------------------------------------------------------------------------------------
// Interface

lobe_result engine_pipelines_create(lobe_device *device, const char *cache_file,
                                    engine_pipelines **pipelines) {
    *pipelines = lobe_allocate(device->host.allocator, 1, sizeof **pipelines);
    if (!*pipelines)
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "out of memory for pipelines");
    engine_pipeline_uses_create(&(*pipelines)->uses);
    pthread_cond_init(&(*pipelines)->made, NULL);
    return engine_pipeline_cache_create(device, cache_file, &(*pipelines)->cache);
}

void engine_pipelines_destroy(lobe_device *device, engine_pipelines **pipelines) {
    if (!*pipelines)
        return;
    for (cached_pipeline *cached = (*pipelines)->pipelines, *next; cached; cached = next) {
        next = cached->next;
        destroy_pipeline(device, cached);
    }
    engine_sampler_cache_destroy(device, &(*pipelines)->samplers);
    engine_pipeline_cache_destroy(device, &(*pipelines)->cache);
    engine_pipeline_uses_destroy(&(*pipelines)->uses);
    pthread_cond_destroy(&(*pipelines)->made);
    lobe_release((*pipelines)->wanted);
    lobe_release(*pipelines);
    *pipelines = NULL;
}

void engine_pipelines_begin_use(lobe_device *device, engine_pipeline_use *use) {
    engine_pipeline_use_begin(&device->pipelines->uses, use);
}

void engine_pipelines_end_use(lobe_device *device, engine_pipeline_use *use) {
    engine_pipeline_use_end(&device->pipelines->uses, use);
}

void engine_pipelines_end_use_after(lobe_device *device, engine_pipeline_use *use,
                                    uint64_t submission) {
    engine_pipeline_use_submitted(&device->pipelines->uses, use, submission);
}

static lobe_result find_compute(lobe_device *device, const engine_compute_parameters *parameters,
                                const engine_pipeline **pipeline, bool *waited) {
    pipeline_key key = {0};
    *waited = false;
    *pipeline = NULL;
    lobe_result result =
        find_shader(device, parameters->shader, VK_SHADER_STAGE_COMPUTE_BIT, &key.shaders[0]);
    if (result == LOBE_OK)
        result = fill_specialisation(device, parameters->specialisation,
                                     parameters->specialisation_count, &key);
    return result == LOBE_OK ? find_or_add(device, NULL, &key, pipeline, waited) : result;
}

lobe_result engine_pipeline_compute(lobe_device *device,
                                    const engine_compute_parameters *parameters,
                                    const engine_pipeline **pipeline) {
    pthread_mutex_lock(&device->found_mutex);
    lobe_result result;
    bool waited;
    do {
        result = find_compute(device, parameters, pipeline, &waited);
    } while (waited);
    pthread_mutex_unlock(&device->found_mutex);
    return result;
}

static lobe_result find_raster(lobe_device *device, const engine_raster_parameters *parameters,
                               const engine_pipeline **pipeline, bool *waited) {
    pipeline_key key = {0};
    *waited = false;
    *pipeline = NULL;
    lobe_result result =
        find_shader(device, parameters->vertex_shader, VK_SHADER_STAGE_VERTEX_BIT, &key.shaders[0]);
    if (result == LOBE_OK && parameters->fragment_shader)
        result = find_shader(device, parameters->fragment_shader, VK_SHADER_STAGE_FRAGMENT_BIT,
                             &key.shaders[1]);
    fill_state(parameters, &key);
    if (result == LOBE_OK)
        result = fill_specialisation(device, parameters->specialisation,
                                     parameters->specialisation_count, &key);
    return result == LOBE_OK ? find_or_add(device, parameters, &key, pipeline, waited) : result;
}

lobe_result engine_pipeline_raster(lobe_device *device, const engine_raster_parameters *parameters,
                                   const engine_pipeline **pipeline) {
    pthread_mutex_lock(&device->found_mutex);
    lobe_result result;
    bool waited;
    do {
        result = find_raster(device, parameters, pipeline, &waited);
    } while (waited);
    pthread_mutex_unlock(&device->found_mutex);
    return result;
}

lobe_result engine_sampler(lobe_device *device, const lobe_sampler *settings, VkSampler *sampler) {
    pthread_mutex_lock(&device->found_mutex);
    const lobe_result result =
        engine_sampler_cache_get(device, &device->pipelines->samplers, settings, sampler);
    pthread_mutex_unlock(&device->found_mutex);
    return result;
}
