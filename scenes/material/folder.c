#include <lobe/scene.h>

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "scenes/format/image_file.h"
#include "scenes/material/carrier.h"
#include "scenes/material/file_name.h"
#include "scenes/material/height_scale.h"
#include "scenes/material/image_channel.h"
#include "scenes/scene/scene.h"

// Used for maps that the folder lacks.
static const float default_grey = 0.5f, default_roughness = 0.5f;

// Files do not state the depth of their relief. This value is common for stone; used if no normal
// map determines it.
static const float default_height_scale = 0.05f;

typedef struct material_folder {
    const char *path;
    const lobe_host *host;
    char *files[MATERIAL_MAP_COUNT]; // names in the folder; NULL: none
    lobe_scene *scene;
    lobe_material material;
} material_folder;

static lobe_result out_of_memory(const material_folder *folder) {
    return lobe_host_fail(folder->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          folder->path);
}

// Of several files for one map, the first in alphabetical order is used, independent of the order
// in which the file system lists them.
static lobe_result consider_file(material_folder *folder, const char *name) {
    material_map map = scenes_material_file_map(name);
    if (map == MATERIAL_MAP_COUNT)
        return LOBE_OK;
    if (!scenes_material_file_is_readable(name)) {
        if (scenes_material_file_is_other_image(name))
            lobe_host_log(folder->host, LOBE_LOG_WARNING, "%s/%s: not read, neither PNG nor JPEG",
                          folder->path, name);
        return LOBE_OK;
    }
    if (folder->files[map] && strcmp(folder->files[map], name) < 0)
        return LOBE_OK;
    char *copy = lobe_copy_text(lobe_host_allocator(folder->host), name);
    if (!copy)
        return out_of_memory(folder);
    lobe_release(folder->files[map]);
    folder->files[map] = copy;
    return LOBE_OK;
}

static lobe_result list_files(material_folder *folder) {
    DIR *directory = opendir(folder->path);
    if (!directory && (errno == ENOENT || errno == ENAMETOOLONG))
        return lobe_host_fail(folder->host, LOBE_ERROR_NOT_FOUND, "%s: no such folder",
                              folder->path);
    if (!directory)
        return lobe_host_fail(folder->host, LOBE_ERROR_READ, "%s: %s", folder->path,
                              strerror(errno));
    lobe_result status = LOBE_OK;
    errno = 0;
    for (struct dirent *entry; !status && (entry = readdir(directory)); errno = 0)
        status = consider_file(folder, entry->d_name);
    if (!status && errno)
        status =
            lobe_host_fail(folder->host, LOBE_ERROR_READ, "%s: %s", folder->path, strerror(errno));
    closedir(directory);
    return status;
}

static lobe_result require_maps(const material_folder *folder) {
    for (int map = 0; map < MATERIAL_MAP_COUNT; map++)
        if (folder->files[map] && map != MATERIAL_MAP_DISPLACEMENT)
            return LOBE_OK;
    return lobe_host_fail(folder->host, LOBE_ERROR_NOT_FOUND,
                          "%s: no PNG or JPEG file is named after a map (albedo, normal, "
                          "roughness, metallic, arm, ao, emissive)",
                          folder->path);
}

// "FOLDER/FILE"; the caller frees it with lobe_release. NULL if out of memory.
static char *file_path(const material_folder *folder, material_map map) {
    const size_t size = strlen(folder->path) + strlen(folder->files[map]) + 2;
    char *path = lobe_allocate(lobe_host_allocator(folder->host), size, 1);
    if (path)
        snprintf(path, size, "%s/%s", folder->path, folder->files[map]);
    return path;
}

// Loads the file of a map; without one, `image` stays empty.
static lobe_result load(const material_folder *folder, material_map map, scene_image_use use,
                        lobe_image *image) {
    *image = (lobe_image){0};
    if (!folder->files[map])
        return LOBE_OK;
    char *path = file_path(folder, map);
    if (!path)
        return out_of_memory(folder);
    lobe_result status = scenes_image_load(path, use, folder->host, image);
    lobe_release(path);
    return status;
}

// Moves an image, which may be empty, to the scene and makes `use` refer to it.
static lobe_result attach(material_folder *folder, const char *name, lobe_image *image,
                          lobe_texture_use *use) {
    uint32_t index;
    if (!image->texels)
        return LOBE_OK;
    lobe_result status = scenes_add_image(folder->scene, name, image, folder->host, &index);
    if (!status)
        use->image = (int32_t)index;
    return status;
}

static lobe_result add_colour(material_folder *folder, material_map map, lobe_texture_use *use) {
    lobe_image image;
    lobe_result status = load(folder, map, SCENE_IMAGE_COLOUR, &image);
    return status ? status : attach(folder, folder->files[map], &image, use);
}

static lobe_result add_normals(material_folder *folder) {
    material_map map =
        folder->files[MATERIAL_MAP_NORMAL] ? MATERIAL_MAP_NORMAL : MATERIAL_MAP_NORMAL_DIRECTX;
    lobe_image image;
    lobe_result status = load(folder, map, SCENE_IMAGE_DATA, &image);
    if (status)
        return status;
    if (map == MATERIAL_MAP_NORMAL_DIRECTX)
        scenes_image_channel_invert(&image, 1);
    return attach(folder, folder->files[map], &image, &folder->material.normal_map);
}

static float find_height_scale(const material_folder *folder, const lobe_image *heights) {
    int32_t normals = folder->material.normal_map.image;
    float scale = default_height_scale;
    if (normals >= 0)
        scenes_height_scale_find(heights, &folder->scene->images[normals].image, &scale);
    return scale;
}

static lobe_result add_heights(material_folder *folder) {
    lobe_image image;
    lobe_result status = load(folder, MATERIAL_MAP_DISPLACEMENT, SCENE_IMAGE_DATA, &image);
    if (status || !image.texels)
        return status;
    folder->material.height_scale = find_height_scale(folder, &image);
    return attach(folder, folder->files[MATERIAL_MAP_DISPLACEMENT], &image,
                  &folder->material.height_map);
}

// One image with roughness and metallic in the channels that glTF defines.
static lobe_result add_packed(material_folder *folder) {
    lobe_material *material = &folder->material;
    bool occlusion = folder->files[MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC];
    material_map map =
        occlusion ? MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC : MATERIAL_MAP_METALLIC_ROUGHNESS;
    lobe_image image;
    lobe_result status = load(folder, map, SCENE_IMAGE_DATA, &image);
    if (!status)
        status = attach(folder, folder->files[map], &image, &material->metallic_roughness_map);
    if (!status && occlusion)
        material->occlusion_map = material->metallic_roughness_map;
    material->roughness = material->metallic = 1;
    return status;
}

// Two images, or one of them, packed into one.
static lobe_result pack_separate(material_folder *folder) {
    lobe_material *material = &folder->material;
    lobe_image roughness, metallic = {0}, packed = {0};
    lobe_result status = load(folder, MATERIAL_MAP_ROUGHNESS, SCENE_IMAGE_DATA, &roughness);
    if (!status)
        status = load(folder, MATERIAL_MAP_METALLIC, SCENE_IMAGE_DATA, &metallic);
    image_channel channels[4] = {{.value = 1}, {&roughness, 0, 1}, {&metallic, 0, 1}, {.value = 1}};
    if (!status)
        status = scenes_image_channel_pack(channels, folder->path, folder->host, &packed);
    if (!status)
        status = attach(folder, "metallic-roughness", &packed, &material->metallic_roughness_map);
    material->roughness = roughness.texels ? 1 : default_roughness;
    if (metallic.texels)
        material->metallic = 1;
    lobe_image_free(&roughness);
    lobe_image_free(&metallic);
    return status;
}

static lobe_result add_roughness_and_metallic(material_folder *folder) {
    char *const *files = folder->files;
    folder->material.roughness = default_roughness;
    // If nothing is known about the material, metal is assumed, because it shows the relief of a
    // grey surface best.
    folder->material.metallic = files[MATERIAL_MAP_ALBEDO] ? 0 : 1;
    if (files[MATERIAL_MAP_OCCLUSION_ROUGHNESS_METALLIC] || files[MATERIAL_MAP_METALLIC_ROUGHNESS])
        return add_packed(folder);
    if (files[MATERIAL_MAP_ROUGHNESS] || files[MATERIAL_MAP_METALLIC])
        return pack_separate(folder);
    return LOBE_OK;
}

static lobe_result add_occlusion(material_folder *folder) {
    lobe_image image;
    lobe_result status = load(folder, MATERIAL_MAP_OCCLUSION, SCENE_IMAGE_DATA, &image);
    return status ? status
                  : attach(folder, folder->files[MATERIAL_MAP_OCCLUSION], &image,
                           &folder->material.occlusion_map);
}

static lobe_result add_material(material_folder *folder) {
    lobe_material *material = &folder->material;
    lobe_material_default(material);
    if (!folder->files[MATERIAL_MAP_ALBEDO])
        for (int channel = 0; channel < 3; channel++)
            material->base_colour[channel] = default_grey;
    if (folder->files[MATERIAL_MAP_EMISSIVE])
        for (int channel = 0; channel < 3; channel++)
            material->emissive[channel] = 1;
    lobe_result status = add_colour(folder, MATERIAL_MAP_ALBEDO, &material->base_colour_map);
    if (!status)
        status = add_colour(folder, MATERIAL_MAP_EMISSIVE, &material->emissive_map);
    if (!status)
        status = add_normals(folder);
    if (!status)
        status = add_heights(folder);
    if (!status)
        status = add_roughness_and_metallic(folder);
    if (!status)
        status = add_occlusion(folder);
    if (!status)
        status = scenes_add_material(folder->scene, folder->path, material, folder->host, NULL);
    return status;
}

lobe_result lobe_scene_open_material(const char *path, lobe_carrier carrier, const lobe_host *host,
                                     lobe_scene **result) {
    if (result)
        *result = NULL;
    if (!path || !result)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_scene_open_material: folder and result must not be NULL");
    if ((unsigned)carrier > LOBE_CARRIER_CLOTH)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "%s: there is no carrier %d", path,
                              (int)carrier);
    material_folder folder = {.path = path, .host = host};
    lobe_result status = list_files(&folder);
    if (!status)
        status = require_maps(&folder);
    if (!status)
        status = scenes_allocate(path, host, &folder.scene);
    if (!status)
        status = add_material(&folder);
    if (!status)
        status = scenes_carrier_add(folder.scene, carrier, host);
    if (!status)
        status = scenes_complete(folder.scene, host);
    for (int map = 0; map < MATERIAL_MAP_COUNT; map++)
        lobe_release(folder.files[map]);
    if (status)
        lobe_scene_destroy(&folder.scene);
    *result = folder.scene;
    return status;
}
