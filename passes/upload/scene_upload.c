#include "passes/upload/scene_upload.h"

#include "passes/upload/device_scene_parts.h"
#include "passes/upload/frame_check.h"
#include "passes/upload/scene_check.h"

static lobe_result upload_white(device_scene *result) {
    uint8_t texel[4] = {255, 255, 255, 255};
    lobe_image image = {LOBE_FORMAT_RGBA8_UNORM, 1, 1, texel};
    return lobe_graph_create_texture(result->graph,
                                     &(lobe_texture_parameters){.name = "white", .image = &image},
                                     &result->white);
}

lobe_result passes_device_scene_upload_environment(device_scene *result) {
    const lobe_environment *environment = result->scene->environment;
    if (!environment)
        return LOBE_OK;
    return lobe_graph_create_texture(
        result->graph,
        &(lobe_texture_parameters){.name = environment->name, .image = &environment->image},
        &result->environment);
}

static bool allocate_tables(device_scene *result) {
    const lobe_scene *scene = result->scene;
    result->images =
        lobe_allocate(result->allocator, scene->image_count + 1, sizeof *result->images);
    result->channels =
        lobe_allocate(result->allocator, scene->image_count + 1, sizeof *result->channels);
    result->alphas =
        lobe_allocate(result->allocator, scene->image_count + 1, sizeof *result->alphas);
    result->given = lobe_allocate(result->allocator, scene->image_count + 1, sizeof *result->given);
    result->given_waves =
        lobe_allocate(result->allocator, scene->material_count + 1, sizeof *result->given_waves);
    result->given_vertices =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->given_vertices);
    result->previous_vertices =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->previous_vertices);
    result->deformed =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->deformed);
    result->deformations =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->deformations);
    result->materials =
        lobe_allocate(result->allocator, scene->material_count + 1, sizeof *result->materials);
    result->vertices =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->vertices);
    result->indices =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->indices);
    result->measures =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->measures);
    return result->images && result->channels && result->alphas && result->given &&
           result->given_waves && result->given_vertices && result->previous_vertices &&
           result->deformed && result->deformations && result->materials && result->vertices &&
           result->indices && result->measures &&
           passes_device_scene_reserve_instances(result, scene->instance_count);
}

static lobe_result create(lobe_device *device, lobe_graph *graph, const lobe_scene *scene,
                          bool keeps_conclusions, const lobe_host *host, device_scene **result) {
    lobe_result status = LOBE_ERROR_OUT_OF_MEMORY;
    const lobe_allocator *allocator = lobe_device_allocator(device);
    *result = lobe_allocate(allocator, 1, sizeof **result);
    if (*result) {
        (*result)->scene = scene;
        (*result)->graph = graph;
        (*result)->allocator = allocator;
        (*result)->keeps_conclusions = keeps_conclusions;
    }
    if (!*result || !allocate_tables(*result)) {
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: out of memory", scene->name);
        goto fail;
    }
    status = passes_scene_check_arrays(scene, host);
    if (status == LOBE_OK)
        status = passes_check_frame(scene, host);
    if (status == LOBE_OK)
        status = upload_white(*result);
    if (status == LOBE_OK)
        status = passes_scene_check_environment(scene, host);
    if (status == LOBE_OK)
        status = passes_device_scene_upload_environment(*result);
    for (size_t i = 0; status == LOBE_OK && i < scene->instance_count; i++)
        status = passes_device_scene_upload_instance(*result, i, host);
    if (status == LOBE_OK) {
        passes_device_scene_link_instances(*result);
        // Other renderers of the scene find it on the device from now on.
        status = lobe_graph_submit_content(graph);
    }
    if (status == LOBE_OK)
        return LOBE_OK;
fail:
    passes_device_scene_destroy(result);
    return status;
}

lobe_result passes_device_scene_create(lobe_device *device, lobe_graph *graph,
                                       const lobe_scene *scene, const lobe_host *host,
                                       device_scene **result) {
    return create(device, graph, scene, false, host, result);
}

lobe_result passes_device_scene_create_for_changing_texels(lobe_device *device, lobe_graph *graph,
                                                           const lobe_scene *scene,
                                                           const lobe_host *host,
                                                           device_scene **result) {
    return create(device, graph, scene, true, host, result);
}

void passes_device_scene_destroy(device_scene **scene) {
    device_scene *s = scene ? *scene : NULL;
    if (!s)
        return;
    for (size_t i = 0; s->images && i < s->scene->image_count; i++)
        lobe_texture_destroy(&s->images[i]);
    for (size_t i = 0; s->materials && i < s->scene->material_count; i++) {
        lobe_buffer_destroy(&s->materials[i].constants);
        lobe_buffer_destroy(&s->materials[i].colour_constants);
        lobe_buffer_destroy(&s->materials[i].map_constants);
        lobe_texture_destroy(&s->materials[i].height_normals);
        lobe_image_free(&s->materials[i].height_normal_texels);
    }
    for (size_t i = 0; s->vertices && s->indices && i < s->scene->mesh_count; i++) {
        lobe_buffer_destroy(&s->vertices[i]);
        lobe_buffer_destroy(&s->indices[i]);
    }
    for (size_t i = 0; s->deformations && i < s->scene->mesh_count; i++)
        passes_device_deformation_destroy(&s->deformations[i]);
    lobe_texture_destroy(&s->white);
    lobe_texture_destroy(&s->environment);
    lobe_release(s->images);
    lobe_release(s->channels);
    lobe_release(s->alphas);
    lobe_release(s->given);
    lobe_release(s->given_waves);
    lobe_release(s->given_vertices);
    lobe_release(s->previous_vertices);
    lobe_release(s->deformed);
    lobe_release(s->deformations);
    lobe_release(s->materials);
    lobe_release(s->vertices);
    lobe_release(s->indices);
    lobe_release(s->measures);
    lobe_release(s->instances);
    lobe_release(s);
    *scene = NULL;
}
