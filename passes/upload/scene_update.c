#include "passes/upload/scene_upload.h"

#include <string.h>

#include "passes/upload/device_scene_parts.h"
#include "passes/upload/material_maps.h"
#include "passes/upload/scene_check.h"

/// One update: what the host declared as changed, and what follows from that.
typedef struct scene_update {
    device_scene *scene;
    const lobe_scene_changes *changes;
    const lobe_host *host;
    bool *materials; ///< to reupload
    bool *instances; ///< to remeasure
    size_t known;    ///< instances before the update
} scene_update;

// ---------------------------------------------------------------------------------------------
// Checks before anything is changed

static lobe_result check_indices(const scene_update *update, const char *what,
                                 const uint32_t *indices, size_t count, size_t limit) {
    if (count > 0 && !indices)
        return lobe_host_fail(update->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: %zu changes of kind '%s', but no array of them",
                              update->scene->scene->name, count, what);
    for (size_t i = 0; i < count; i++)
        if (indices[i] >= limit)
            return lobe_host_fail(update->host, LOBE_ERROR_INVALID_ARGUMENT,
                                  "%s: %s %u of %zu cannot have changed",
                                  update->scene->scene->name, what, indices[i], limit);
    return LOBE_OK;
}

static lobe_result check_all_indices(const scene_update *update) {
    const lobe_scene *scene = update->scene->scene;
    const lobe_scene_changes *changes = update->changes;
    lobe_result result = passes_scene_check_instance_array(scene, update->host);
    if (result == LOBE_OK)
        result = check_indices(update, "image", changes->images, changes->image_count,
                               scene->image_count);
    if (result == LOBE_OK)
        result = check_indices(update, "material", changes->materials, changes->material_count,
                               scene->material_count);
    if (result == LOBE_OK)
        result =
            check_indices(update, "mesh", changes->meshes, changes->mesh_count, scene->mesh_count);
    if (result == LOBE_OK)
        result = check_indices(update, "instance", changes->instances, changes->instance_count,
                               scene->instance_count);
    return result;
}

/// Checks the material, and those of its images that the device does not have yet.
static lobe_result check_material(const scene_update *update, uint32_t index) {
    const lobe_scene *scene = update->scene->scene;
    lobe_result result = passes_scene_check_material(scene, index, update->host);
    for (uint32_t map = 0; result == LOBE_OK && map < MAP_HEIGHT; map++) {
        const lobe_texture_use *use = passes_material_map_use(scene, &scene->materials[index], map);
        if (use && !update->scene->images[use->image])
            result = passes_scene_check_image(scene, (size_t)use->image, NULL, update->host);
    }
    return result;
}

/// Checks the instance, and what it needs that the device does not have yet.
static lobe_result check_instance(const scene_update *update, size_t index) {
    const lobe_scene *scene = update->scene->scene;
    lobe_result result = passes_device_scene_check_instance(scene, index, update->host);
    if (result != LOBE_OK)
        return result;
    uint32_t mesh = scene->instances[index].mesh, material = scene->instances[index].material;
    if (!update->scene->indices[mesh])
        result = passes_scene_check_mesh(scene, mesh, update->host);
    if (result == LOBE_OK && !update->scene->materials[material].constants)
        result = check_material(update, material);
    return result;
}

/// The part of the n-th changed image that changed; NULL: all of it.
static const lobe_rectangle *changed_part(const scene_update *update, size_t n) {
    static const lobe_rectangle all = {0};
    const lobe_rectangle *parts = update->changes->image_parts;
    return parts && memcmp(&parts[n], &all, sizeof all) != 0 ? &parts[n] : NULL;
}

static bool reads_image(const device_material *material, uint32_t map, uint32_t image) {
    const lobe_texture_use *use = material->maps[map].use;
    return use && (uint32_t)use->image == image;
}

/// Except for heights: no lobe depends on them, and who reads them uploads them.
static bool uses_image(const device_material *material, uint32_t image) {
    for (uint32_t map = 0; map < MAP_HEIGHT; map++)
        if (reads_image(material, map, image))
            return true;
    return false;
}

/// Whether a material on the device reads the image.
static bool is_used(const device_scene *scene, uint32_t image) {
    for (size_t m = 0; m < scene->scene->material_count; m++)
        if (uses_image(&scene->materials[m], image))
            return true;
    return false;
}

static lobe_result check_image(const scene_update *update, size_t n) {
    const uint32_t index = update->changes->images[n];
    const lobe_scene_image *image = &update->scene->scene->images[index];
    const lobe_texture *texture = update->scene->images[index];
    const lobe_rectangle *part = changed_part(update, n);
    if (part && !lobe_rectangle_lies_within(part, image->image.width, image->image.height))
        return lobe_host_fail(update->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: image '%s' is %ux%u, without %ux%u changed texels at (%u, %u)",
                              update->scene->scene->name, image->name, image->image.width,
                              image->image.height, part->width, part->height, part->x, part->y);
    if (!texture && !is_used(update->scene, index))
        return LOBE_OK;
    const bool keeps = texture && lobe_texture_takes(texture, &image->image);
    return passes_scene_check_image(update->scene->scene, index, keeps ? part : NULL, update->host);
}

/// Those that the scene has more than before.
static lobe_result check_added_instances(const scene_update *update) {
    const lobe_scene *scene = update->scene->scene;
    lobe_result result = LOBE_OK;
    for (size_t i = update->known; result == LOBE_OK && i < scene->instance_count; i++)
        result = check_instance(update, i);
    return result;
}

static lobe_result check_content(const scene_update *update) {
    const device_scene *scene = update->scene;
    const lobe_scene_changes *changes = update->changes;
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < changes->image_count; i++)
        result = check_image(update, i);
    for (size_t i = 0; result == LOBE_OK && i < changes->material_count; i++)
        if (scene->materials[changes->materials[i]].constants)
            result = check_material(update, changes->materials[i]);
    for (size_t i = 0; result == LOBE_OK && i < changes->mesh_count; i++)
        if (scene->indices[changes->meshes[i]])
            result = passes_scene_check_mesh(scene->scene, changes->meshes[i], update->host);
    for (size_t i = 0; result == LOBE_OK && i < changes->instance_count; i++)
        result = check_instance(update, changes->instances[i]);
    if (result == LOBE_OK)
        result = check_added_instances(update);
    if (result == LOBE_OK && changes->environment)
        result = passes_scene_check_environment(scene->scene, update->host);
    return result;
}

// ---------------------------------------------------------------------------------------------
// What follows from a change

static void mark_materials(scene_update *update) {
    const lobe_scene_changes *changes = update->changes;
    device_scene *scene = update->scene;
    // Adding or removing the environment also adds or removes the maps that only it needs
    // (occlusion).
    bool other_maps = changes->environment && !scene->environment != !scene->scene->environment;
    for (size_t m = 0; other_maps && m < scene->scene->material_count; m++)
        update->materials[m] = scene->materials[m].constants != NULL;
    for (size_t m = 0; m < scene->scene->material_count; m++)
        for (size_t i = 0; i < changes->image_count; i++)
            update->materials[m] |=
                uses_image(&scene->materials[m], changes->images[i]) ||
                reads_image(&scene->materials[m], MAP_HEIGHT, changes->images[i]);
    // A material that no instance uses is not on the device.
    for (size_t i = 0; i < changes->material_count; i++)
        if (scene->materials[changes->materials[i]].constants)
            update->materials[changes->materials[i]] = true;
}

static void mark_instances(scene_update *update) {
    const lobe_scene_changes *changes = update->changes;
    const lobe_scene *scene = update->scene->scene;
    for (size_t i = 0; i < changes->instance_count; i++)
        update->instances[changes->instances[i]] = true;
    for (size_t n = 0; n < update->known && n < scene->instance_count; n++) {
        const device_instance *instance = &update->scene->instances[n];
        update->instances[n] |= update->materials[instance->material];
        for (size_t i = 0; i < changes->mesh_count; i++)
            update->instances[n] |= instance->mesh == changes->meshes[i];
    }
    for (size_t n = update->known; n < scene->instance_count; n++)
        update->instances[n] = true;
}

// ---------------------------------------------------------------------------------------------
// The change

static bool keeps_texture(const scene_update *update, uint32_t index) {
    const lobe_scene_image *image = &update->scene->scene->images[index];
    return !image->on_device && lobe_texture_takes(update->scene->images[index], &image->image);
}

/// Where extent and format stay the same.
static lobe_result update_texels(const scene_update *update, size_t n) {
    const uint32_t index = update->changes->images[n];
    for (uint32_t i = 0; i < 3; i++) {
        image_channel *channel = &update->scene->channels[index].of[i];
        channel->known = channel->varies && update->scene->keeps_conclusions;
    }
    update->scene->alphas[index].known = false;
    if (!keeps_texture(update, index))
        return LOBE_OK;
    return lobe_texture_update_part(update->scene->images[index],
                                    &update->scene->scene->images[index].image,
                                    changed_part(update, n));
}

/// Where there is no texture, materials that need one create it.
static void drop_other_textures(const scene_update *update) {
    const lobe_scene_changes *changes = update->changes;
    for (size_t i = 0; i < changes->image_count; i++)
        if (!keeps_texture(update, changes->images[i]))
            lobe_texture_destroy(&update->scene->images[changes->images[i]]);
}

static lobe_result update_mesh(const scene_update *update, uint32_t index) {
    device_scene *scene = update->scene;
    return scene->indices[index] ? passes_device_scene_upload_mesh(scene, index) : LOBE_OK;
}

static bool environment_keeps_texture(const scene_update *update) {
    const lobe_environment *environment = update->scene->scene->environment;
    return environment && lobe_texture_takes(update->scene->environment, &environment->image);
}

static lobe_result replace_environment(const scene_update *update) {
    if (environment_keeps_texture(update))
        return LOBE_OK;
    lobe_texture_destroy(&update->scene->environment);
    return passes_device_scene_upload_environment(update->scene);
}

/// Other texels are other lobes.
static void mark_new_texels(const scene_update *update) {
    const lobe_scene_changes *changes = update->changes;
    for (size_t m = 0; m < update->scene->scene->material_count; m++) {
        device_material *material = &update->scene->materials[m];
        for (size_t i = 0; i < changes->image_count; i++) {
            material->version += uses_image(material, changes->images[i]);
            for (uint32_t map = 0; map < MAP_COUNT; map++)
                material->texel_versions[map] += reads_image(material, map, changes->images[i]);
        }
    }
}

/// Whatever fails here, the copy can be drawn: each texture has its former content or the new.
static lobe_result apply_texels(const scene_update *update) {
    const lobe_scene_changes *changes = update->changes;
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < changes->image_count; i++)
        result = update_texels(update, i);
    if (result == LOBE_OK && changes->environment && environment_keeps_texture(update))
        result = lobe_texture_update(update->scene->environment,
                                     &update->scene->scene->environment->image);
    mark_new_texels(update);
    return result;
}

static lobe_result apply_rest(const scene_update *update) {
    const lobe_scene_changes *changes = update->changes;
    const lobe_scene *scene = update->scene->scene;
    lobe_result result = LOBE_OK;
    drop_other_textures(update);
    for (size_t i = 0; result == LOBE_OK && i < scene->material_count; i++)
        if (update->materials[i])
            result = passes_device_scene_upload_material(update->scene, (uint32_t)i, update->host);
    for (size_t i = 0; result == LOBE_OK && i < changes->mesh_count; i++)
        result = update_mesh(update, changes->meshes[i]);
    for (size_t i = 0; result == LOBE_OK && i < scene->instance_count; i++)
        if (update->instances[i])
            result = passes_device_scene_upload_instance(update->scene, i, update->host);
    if (result == LOBE_OK)
        passes_device_scene_link_instances(update->scene);
    if (result == LOBE_OK && changes->environment)
        result = replace_environment(update);
    return result;
}

static lobe_result apply(const scene_update *update) {
    lobe_result result = apply_texels(update);
    if (result == LOBE_OK) {
        result = apply_rest(update);
        update->scene->torn = result != LOBE_OK;
    }
    return result;
}

static bool allocate(scene_update *update) {
    const lobe_scene *scene = update->scene->scene;
    const lobe_allocator *allocator = lobe_host_allocator(update->host);
    update->materials =
        lobe_allocate(allocator, scene->material_count + 1, sizeof *update->materials);
    update->instances =
        lobe_allocate(allocator, scene->instance_count + 1, sizeof *update->instances);
    return update->materials && update->instances &&
           passes_device_scene_reserve_instances(update->scene, scene->instance_count);
}

lobe_result passes_device_scene_update(device_scene *scene, const lobe_scene_changes *changes,
                                       const lobe_host *host) {
    scene_update update = {
        .scene = scene, .changes = changes, .host = host, .known = scene->instance_count};
    lobe_result result = check_all_indices(&update);
    if (result == LOBE_OK)
        result = check_content(&update);
    if (result != LOBE_OK)
        return result;
    if (allocate(&update)) {
        mark_materials(&update);
        mark_instances(&update);
        result = apply(&update);
    } else {
        result =
            lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", scene->scene->name);
    }
    lobe_release(update.materials);
    lobe_release(update.instances);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Materials that poses move

/// NULL: the material stands still, or the rig names one that is not there.
static device_material *find_posed(const device_scene *scene, const lobe_posed_material *posed) {
    return posed->material >= 0 && (size_t)posed->material < scene->scene->material_count
               ? &scene->materials[posed->material]
               : NULL;
}

void passes_device_scene_take_pose(device_scene *scene) {
    const lobe_rig *rig = scene->scene->rig;
    for (size_t i = 0; rig && i < rig->material_count; i++) {
        device_material *material = find_posed(scene, &rig->materials[i]);
        if (material)
            material->pose_version = rig->materials[i].version;
    }
}

/// Returns how many have moved, the first `room` of them in `materials`.
static size_t list_moved(const device_scene *scene, uint32_t *materials, size_t room) {
    const lobe_rig *rig = scene->scene->rig;
    size_t count = 0;
    for (size_t i = 0; rig && i < rig->material_count; i++) {
        const device_material *material = find_posed(scene, &rig->materials[i]);
        if (!material || material->pose_version == rig->materials[i].version)
            continue;
        if (count < room)
            materials[count] = (uint32_t)rig->materials[i].material;
        ++count;
    }
    return count;
}

lobe_result passes_device_scene_follow_pose(device_scene *scene, const lobe_host *host,
                                            bool *moved) {
    const size_t count = list_moved(scene, NULL, 0);
    *moved = count > 0;
    if (count == 0)
        return LOBE_OK;
    uint32_t *materials = lobe_allocate(lobe_host_allocator(host), count, sizeof *materials);
    if (!materials)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              scene->scene->name);
    const lobe_scene_changes changes = {.materials = materials,
                                        .material_count = list_moved(scene, materials, count)};
    const lobe_result result = passes_device_scene_update(scene, &changes, host);
    lobe_release(materials);
    if (result == LOBE_OK)
        passes_device_scene_take_pose(scene);
    return result;
}
