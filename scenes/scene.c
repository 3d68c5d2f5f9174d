#include "scenes/scene.h"

#include <stdlib.h>
#include <string.h>

#include "scenes/mesh.h"

static lobe_result out_of_memory(const lobe_scene *scene, const lobe_log *log) {
    return lobe_log_fail(log, LOBE_ERROR_OUT_OF_MEMORY, "scene '%s': out of memory", scene->name);
}

lobe_result scene_allocate(const char *name, const lobe_log *log, lobe_scene **scene) {
    *scene = calloc(1, sizeof **scene);
    if (*scene)
        (*scene)->name = strdup(name);
    if (*scene && (*scene)->name)
        return LOBE_OK;
    lobe_scene_destroy(scene);
    return lobe_log_fail(log, LOBE_ERROR_OUT_OF_MEMORY, "scene '%s': out of memory", name);
}

// Room for one more element. Arrays carry no capacity: it is the power of two not below the
// count, so that a full one is recognised by its count.
static bool grow(void **array, size_t count, size_t element_size) {
    if ((count & (count - 1)) != 0)
        return true;
    void *larger = realloc(*array, (count ? 2 * count : 1) * element_size);
    if (!larger)
        return false;
    *array = larger;
    return true;
}

// Appends a copy of `element`; false, nothing changed, without memory.
static bool append(void **array, size_t *count, const void *element, size_t element_size,
                   uint32_t *index) {
    if (*count >= UINT32_MAX || !grow(array, *count, element_size))
        return false;
    memcpy((char *)*array + *count * element_size, element, element_size);
    if (index)
        *index = (uint32_t)*count;
    ++*count;
    return true;
}

lobe_result scene_add_image(lobe_scene *scene, const char *name, lobe_image *image,
                            const lobe_log *log, uint32_t *index) {
    lobe_scene_image element = {strdup(name), *image};
    bool added = element.name && append((void **)&scene->images, &scene->image_count, &element,
                                        sizeof element, index);
    if (added) {
        *image = (lobe_image){0};
        return LOBE_OK;
    }
    free(element.name);
    lobe_image_free(image);
    return out_of_memory(scene, log);
}

lobe_result scene_add_material(lobe_scene *scene, const char *name, const lobe_material *material,
                               const lobe_log *log, uint32_t *index) {
    lobe_material element = *material;
    element.name = strdup(name);
    if (element.name &&
        append((void **)&scene->materials, &scene->material_count, &element, sizeof element, index))
        return LOBE_OK;
    free(element.name);
    return out_of_memory(scene, log);
}

lobe_result scene_add_mesh(lobe_scene *scene, lobe_mesh *mesh, const lobe_log *log,
                           uint32_t *index) {
    mesh_compute_bounds(mesh);
    if (append((void **)&scene->meshes, &scene->mesh_count, mesh, sizeof *mesh, index)) {
        *mesh = (lobe_mesh){0};
        return LOBE_OK;
    }
    mesh_free(mesh);
    return out_of_memory(scene, log);
}

lobe_result scene_add_instance(lobe_scene *scene, uint32_t mesh, uint32_t material,
                               const float transform[16], const lobe_log *log) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    lobe_instance element = {.mesh = mesh, .material = material};
    memcpy(element.transform, transform ? transform : identity, sizeof element.transform);
    if (append((void **)&scene->instances, &scene->instance_count, &element, sizeof element, NULL))
        return LOBE_OK;
    return out_of_memory(scene, log);
}

lobe_result scene_place_mesh(lobe_scene *scene, lobe_mesh *mesh, uint32_t material,
                             const lobe_log *log) {
    uint32_t index;
    const lobe_result result = scene_add_mesh(scene, mesh, log, &index);
    return result != LOBE_OK ? result : scene_add_instance(scene, index, material, NULL, log);
}

lobe_result scene_add_light(lobe_scene *scene, const lobe_light *light, const lobe_log *log) {
    if (append((void **)&scene->lights, &scene->light_count, light, sizeof *light, NULL))
        return LOBE_OK;
    return out_of_memory(scene, log);
}

static void free_elements(lobe_scene *scene) {
    for (size_t i = 0; i < scene->image_count; i++) {
        free(scene->images[i].name);
        lobe_image_free(&scene->images[i].image);
    }
    for (size_t i = 0; i < scene->material_count; i++)
        free(scene->materials[i].name);
    for (size_t i = 0; i < scene->mesh_count; i++)
        mesh_free(&scene->meshes[i]);
}

void lobe_scene_destroy(lobe_scene **scene) {
    if (!scene || !*scene)
        return;
    lobe_scene *old = *scene;
    *scene = NULL;
    free_elements(old);
    free(old->images);
    free(old->materials);
    free(old->meshes);
    free(old->instances);
    free(old->lights);
    lobe_environment_destroy(&old->environment);
    free(old->name);
    free(old);
}
