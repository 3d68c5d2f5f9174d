#include "scenes/scene/scene.h"

#include <string.h>

#include "scenes/animation/rig.h"
#include "scenes/mesh/mesh.h"

static lobe_result out_of_memory(const lobe_scene *scene, const lobe_host *host) {
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "scene '%s': out of memory", scene->name);
}

lobe_result scenes_allocate(const char *name, const lobe_host *host, lobe_scene **scene) {
    *scene = lobe_allocate(lobe_host_allocator(host), 1, sizeof **scene);
    if (*scene)
        (*scene)->name = lobe_copy_text(lobe_host_allocator(host), name);
    if (*scene && (*scene)->name)
        return LOBE_OK;
    lobe_scene_destroy(scene);
    return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "scene '%s': out of memory", name);
}

// Makes room for one more element. Arrays store no capacity: it is the power of two not below the
// count, so that a full array is recognised by its count.
static bool grow(const lobe_allocator *allocator, void **array, size_t count, size_t element_size) {
    if ((count & (count - 1)) != 0)
        return true;
    void *larger = lobe_reallocate(allocator, *array, count ? 2 * count : 1, element_size);
    if (!larger)
        return false;
    *array = larger;
    return true;
}

// Appends a copy of `element`. False, with nothing changed, if memory runs out.
static bool append(const lobe_host *host, void **array, size_t *count, const void *element,
                   size_t element_size, uint32_t *index) {
    if (*count >= UINT32_MAX || !grow(lobe_host_allocator(host), array, *count, element_size))
        return false;
    memcpy((char *)*array + *count * element_size, element, element_size);
    if (index)
        *index = (uint32_t)*count;
    ++*count;
    return true;
}

lobe_result scenes_add_image(lobe_scene *scene, const char *name, lobe_image *image,
                             const lobe_host *host, uint32_t *index) {
    lobe_scene_image element = {.name = lobe_copy_text(lobe_host_allocator(host), name),
                                .image = *image};
    bool added = element.name && append(host, (void **)&scene->images, &scene->image_count,
                                        &element, sizeof element, index);
    if (added) {
        *image = (lobe_image){0};
        return LOBE_OK;
    }
    lobe_release(element.name);
    lobe_image_free(image);
    return out_of_memory(scene, host);
}

lobe_result scenes_add_material(lobe_scene *scene, const char *name, const lobe_material *material,
                                const lobe_host *host, uint32_t *index) {
    lobe_material element = *material;
    element.name = lobe_copy_text(lobe_host_allocator(host), name);
    if (element.name && append(host, (void **)&scene->materials, &scene->material_count, &element,
                               sizeof element, index))
        return LOBE_OK;
    lobe_release(element.name);
    return out_of_memory(scene, host);
}

lobe_result scenes_add_mesh(lobe_scene *scene, lobe_mesh *mesh, const lobe_host *host,
                            uint32_t *index) {
    scenes_mesh_compute_bounds(mesh);
    if (append(host, (void **)&scene->meshes, &scene->mesh_count, mesh, sizeof *mesh, index)) {
        *mesh = (lobe_mesh){0};
        return LOBE_OK;
    }
    scenes_mesh_free(mesh);
    return out_of_memory(scene, host);
}

lobe_result scenes_add_instance(lobe_scene *scene, uint32_t mesh, uint32_t material,
                                const float transform[16], const lobe_host *host) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    lobe_instance element = {.mesh = mesh, .material = material};
    memcpy(element.transform, transform ? transform : identity, sizeof element.transform);
    if (append(host, (void **)&scene->instances, &scene->instance_count, &element, sizeof element,
               NULL))
        return LOBE_OK;
    return out_of_memory(scene, host);
}

lobe_result scenes_place_mesh(lobe_scene *scene, lobe_mesh *mesh, uint32_t material,
                              const lobe_host *host) {
    uint32_t index = 0;
    const lobe_result result = scenes_add_mesh(scene, mesh, host, &index);
    return result != LOBE_OK ? result : scenes_add_instance(scene, index, material, NULL, host);
}

lobe_result scenes_add_light(lobe_scene *scene, const lobe_light *light, const lobe_host *host) {
    if (append(host, (void **)&scene->lights, &scene->light_count, light, sizeof *light, NULL))
        return LOBE_OK;
    return out_of_memory(scene, host);
}

lobe_result scenes_add_lights(lobe_scene *scene, const lobe_light *lights, size_t count,
                              const lobe_host *host) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; !status && i < count; i++)
        status = scenes_add_light(scene, &lights[i], host);
    return status;
}

void scenes_set_camera(lobe_scene *scene, const float eye[3], const float target[3],
                       float degrees) {
    lobe_camera camera = {.up = {0, 1, 0}, .near_plane = 0.05f};
    memcpy(camera.eye, eye, sizeof camera.eye);
    memcpy(camera.target, target, sizeof camera.target);
    camera.vertical_field_of_view = degrees * 0.017453292f;
    scene->camera = camera;
    scene->has_camera = true;
}

void lobe_scene_set_environment(lobe_scene *scene, lobe_environment *environment) {
    if (!scene)
        return;
    lobe_environment_destroy(&scene->environment);
    scene->environment = environment;
    scene->has_added_light = false;
}

static void free_elements(lobe_scene *scene) {
    for (size_t i = 0; i < scene->image_count; i++) {
        lobe_release(scene->images[i].name);
        lobe_image_free(&scene->images[i].image);
    }
    for (size_t i = 0; i < scene->material_count; i++)
        lobe_release(scene->materials[i].name);
    for (size_t i = 0; i < scene->mesh_count; i++)
        scenes_mesh_free(&scene->meshes[i]);
}

void lobe_scene_destroy(lobe_scene **scene) {
    if (!scene || !*scene)
        return;
    lobe_scene *old = *scene;
    *scene = NULL;
    free_elements(old);
    lobe_release(old->images);
    lobe_release(old->materials);
    lobe_release(old->meshes);
    lobe_release(old->instances);
    lobe_release(old->lights);
    scenes_rig_free(&old->rig);
    lobe_environment_destroy(&old->environment);
    lobe_release(old->name);
    lobe_release(old);
}
