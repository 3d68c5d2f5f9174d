#include <lobe/maps.h>

#include <string.h>

#include "passes/context/given_content.h"
#include "passes/context/knob_values.h"
#include "passes/filters/material_shading.h"
#include "passes/filters/settings.h"
#include "passes/filters/slots.h"
#include "passes/maps/colours/colour_correlation.h"
#include "passes/maps/waves.h"
#include "passes/own_shading/material_scene.h"
#include "passes/upload/device_scene_parts.h"
#include "passes/upload/frame_check.h"
#include "passes/upload/scene_upload.h"

struct lobe_maps {
    lobe_host host;
    lobe_maps_parameters parameters;
    const lobe_filter *filter;
    lobe_settings settings;
    lobe_graph *graph;
    material_scene *materials;
    device_scene *uploaded; ///< NULL: an update failed half-way
    filter_slots *slots;
    environment_state environment;
    lobe_resource *filtered;        ///< passes_filtered_images_count of them
    specialisation_list *constants; ///< one per material
    bool *closed, *waves;           ///< the same
    bool changed;                   ///< since the last recording
};

// ---------------------------------------------------------------------------------------------
// Creation

static lobe_result check_parameters(const lobe_maps_parameters *parameters, const lobe_host *host) {
    if (parameters->scene->material_count == 0)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "lobe_maps_create: the scene has no materials");
    if (parameters->lights_at_once > 4)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_maps_create: %u lights at once, more than 4",
                              parameters->lights_at_once);
    if (parameters->filter && lobe_filter_supersamples(parameters->filter))
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_maps_create: filter '%s' has no maps: it supersamples",
                              lobe_filter_name(parameters->filter));
    return LOBE_OK;
}

static bool allocate_tables(lobe_maps *maps) {
    const lobe_allocator *allocator = maps->host.allocator;
    const lobe_scene *scene = maps->parameters.scene;
    const size_t materials = scene->material_count;
    maps->materials =
        passes_material_scene_create(scene, maps->parameters.vertex_colours, allocator);
    maps->filtered =
        lobe_allocate(allocator, passes_filtered_images_count(scene) + 1, sizeof *maps->filtered);
    maps->constants = lobe_allocate(allocator, materials + 1, sizeof *maps->constants);
    maps->closed = lobe_allocate(allocator, materials + 1, sizeof *maps->closed);
    maps->waves = lobe_allocate(allocator, materials + 1, sizeof *maps->waves);
    return maps->materials && maps->filtered && maps->constants && maps->closed && maps->waves;
}

/// Points into the object and to `images`.
static filter_context context_of(lobe_maps *maps, filtered_images *images) {
    const lobe_scene *scene = &maps->materials->scene;
    *images = passes_filtered_images_of(maps->filtered, scene);
    return (filter_context){
        .graph = maps->graph,
        .scene = maps->uploaded,
        .view = {&scene->camera, 1, 1},
        .filter = maps->filter,
        .settings = &maps->settings,
        .images = images,
        .host = &maps->host,
    };
}

static lobe_result fill(lobe_maps *maps, lobe_device *device) {
    const lobe_host *host = &maps->host;
    filtered_images images;
    lobe_result result =
        passes_settings_choose(maps->parameters.filter, maps->parameters.settings,
                               lobe_device_describe(device), host, &maps->filter, &maps->settings);
    if (result != LOBE_OK)
        return result;
    if (!allocate_tables(maps))
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "maps: out of memory");
    result = lobe_graph_create(device, &maps->graph);
    if (result != LOBE_OK)
        return result;
    lobe_graph_keep_apart(maps->graph);
    result = passes_device_scene_create_for_changing_texels(
        device, maps->graph, &maps->materials->scene, host, &maps->uploaded);
    if (result != LOBE_OK)
        return result;
    const filter_context context = context_of(maps, &images);
    passes_filter_warn(maps->filter, maps->uploaded, host);
    result = passes_environment_light_check(&context);
    return result == LOBE_OK ? passes_colour_correlations_ask(&context) : result;
}

lobe_result lobe_maps_create(lobe_device *device, const lobe_maps_parameters *parameters,
                             const lobe_host *host, lobe_maps **maps) {
    if (maps)
        *maps = NULL;
    if (!device || !parameters || !parameters->scene || !maps)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_maps_create: device, parameters, scene and maps must not be NULL");
    lobe_result result = check_parameters(parameters, host);
    if (result != LOBE_OK)
        return result;
    const lobe_allocator *allocator = lobe_device_allocator(device);
    *maps = lobe_allocate(allocator, 1, sizeof **maps);
    if (!*maps)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "maps: out of memory");
    if (host)
        (*maps)->host = *host;
    (*maps)->host.allocator = allocator;
    (*maps)->parameters = *parameters;
    (*maps)->changed = true;
    result = fill(*maps, device);
    (*maps)->parameters.settings = NULL; // copied
    if (result != LOBE_OK)
        lobe_maps_destroy(maps);
    return result;
}

static void forget_scene(lobe_maps *maps) {
    passes_filter_slots_destroy(&maps->slots);
    passes_device_scene_destroy(&maps->uploaded);
    passes_environment_light_forget(&maps->environment);
}

void lobe_maps_destroy(lobe_maps **maps) {
    lobe_maps *gone = maps ? *maps : NULL;
    if (!gone)
        return;
    forget_scene(gone);
    lobe_graph_destroy(&gone->graph);
    lobe_release(gone->materials);
    lobe_release(gone->filtered);
    lobe_release(gone->constants);
    lobe_release(gone->closed);
    lobe_release(gone->waves);
    lobe_release(gone);
    *maps = NULL;
}

// ---------------------------------------------------------------------------------------------
// Changes

static lobe_result check_changes(const lobe_maps *maps, const lobe_scene_changes *changes) {
    if (!maps->uploaded)
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: an update of the maps failed half-way; make them anew",
                              maps->materials->scene.name);
    if (changes->mesh_count > 0 || changes->instance_count > 0)
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: maps have no meshes or instances that could change",
                              maps->materials->scene.name);
    return LOBE_OK;
}

lobe_result lobe_maps_update(lobe_maps *maps, const lobe_scene_changes *changes) {
    if (!maps || !changes)
        return lobe_host_fail(maps ? &maps->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_maps_update: maps and changes must not be NULL");
    lobe_result result = check_changes(maps, changes);
    if (result != LOBE_OK)
        return result;
    if (changes->environment)
        passes_material_scene_update(maps->materials);
    maps->changed = true;
    result = passes_device_scene_update(maps->uploaded, changes, &maps->host);
    // Also after an error: it may have come when some materials were already changed.
    passes_filter_slots_update(maps->slots, maps->uploaded);
    if (result == LOBE_OK && changes->environment)
        passes_environment_light_invalidate(&maps->environment);
    if (maps->uploaded->torn)
        forget_scene(maps);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Recording

static void export_material(lobe_maps *maps, const filter_context *context,
                            const environment_light *light, uint32_t index, lobe_pass *pass) {
    const device_material *material = &context->scene->materials[index];
    const uint32_t lights = maps->parameters.lights_at_once;
    filtered_appearance appearance;
    passes_filter_slots_build(&maps->slots, context, index, &appearance);
    specialisation_list *list = &maps->constants[index];
    *list = (specialisation_list){.graph = context->graph};
    passes_specialise(list, SPECIALISE_VERTEX_COLOUR, maps->parameters.vertex_colours);
    passes_specialise(list, SPECIALISE_LIGHTS_AT_ONCE,
                      passes_environment_light_lights_at_once(light, lights));
    passes_material_shading_specialise(context, light, material, &appearance, list);
    maps->closed[index] = passes_material_shading_is_closed(context, material);
    maps->waves[index] = passes_waves_are_drawn(context, material);
    lobe_binding bindings[MATERIAL_SHADING_BINDINGS];
    char shader[SHADING_NAME_SIZE];
    passes_material_shading_name(context, light, material, false, shader);
    const size_t count =
        passes_material_shading_bind(context, light, material, &appearance, bindings);
    lobe_pass_export(pass, &(lobe_export){shader, bindings, count});
}

static void declare(lobe_maps *maps) {
    static const shading_sample whole_pixel = {.position = {0.5f, 0.5f}, .footprint = 1};
    const lobe_scene *scene = &maps->materials->scene;
    filtered_images images;
    const filter_context context = context_of(maps, &images);
    const environment_work work = {.state = &maps->environment};
    memset(maps->filtered, 0, passes_filtered_images_count(scene) * sizeof *maps->filtered);
    passes_given_maps_take(&context, maps->parameters.give_content, maps->parameters.user);
    const environment_light light = passes_environment_light_build(&context, &work);
    lobe_pass *pass = lobe_graph_add_pass(maps->graph, LOBE_PASS_EXPORT, "maps");
    passes_knobs_bind(&context, pass);
    passes_environment_light_bind(&light, &context, pass, &whole_pixel);
    for (uint32_t i = 0; i < scene->material_count; i++)
        export_material(maps, &context, &light, i, pass);
}

/// The host's passes may write other texels in every frame.
static bool may_have_changed(const lobe_maps *maps) {
    const lobe_scene *scene = &maps->materials->scene;
    bool changed = maps->changed;
    for (size_t i = 0; i < scene->image_count; i++)
        changed |= scene->images[i].on_device;
    for (size_t i = 0; i < scene->material_count; i++)
        changed |= scene->materials[i].waves.layers > 0;
    return changed;
}

lobe_result lobe_maps_record(lobe_maps *maps, const lobe_vulkan_submission *submission) {
    static const lobe_scene_changes nothing;
    if (!maps || !submission)
        return lobe_host_fail(maps ? &maps->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_maps_record: maps and submission must not be NULL");
    lobe_result result = check_changes(maps, &nothing);
    if (result == LOBE_OK)
        result = passes_check_frame(&maps->materials->scene, &maps->host);
    if (result == LOBE_OK && maps->filter->reads_heights)
        result = passes_device_scene_upload_heights(maps->uploaded, &maps->host);
    if (result != LOBE_OK || !may_have_changed(maps))
        return result;
    lobe_graph_set_frames_in_flight(maps->graph, maps->parameters.frames_in_flight);
    lobe_graph_begin(maps->graph);
    declare(maps);
    result = lobe_graph_submit(maps->graph, submission);
    maps->changed = result != LOBE_OK || lobe_graph_settles(maps->graph);
    return result;
}

// ---------------------------------------------------------------------------------------------
// What was recorded

lobe_result lobe_maps_get(const lobe_maps *maps, uint32_t material, lobe_material_maps *result) {
    if (result)
        *result = (lobe_material_maps){0};
    if (!maps || !result)
        return lobe_host_fail(maps ? &maps->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_maps_get: maps and result must not be NULL");
    const lobe_scene *scene = &maps->materials->scene;
    if (material >= scene->material_count)
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: no material %u: there are %zu", scene->name, material,
                              scene->material_count);
    result->descriptors = lobe_graph_exported(maps->graph, material, &result->descriptor_count);
    if (!result->descriptors)
        return lobe_host_fail(&maps->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: the maps of material '%s' have not been recorded", scene->name,
                              scene->materials[material].name);
    result->constants = maps->constants[material].items;
    result->constant_count = maps->constants[material].count;
    result->closed_surface = maps->closed[material];
    result->waves = maps->waves[material];
    return LOBE_OK;
}

lobe_graph *lobe_maps_graph(lobe_maps *maps) {
    return maps ? maps->graph : NULL;
}
