#include <lobe/scene.h>

#include <stdio.h>
#include <string.h>

#include "scenes/format/image_file.h"
#include "scenes/material/carrier.h"
#include "scenes/material/folder.h"
#include "scenes/material/folder_files.h"
#include "scenes/material/height_scale.h"
#include "scenes/material/image_channel.h"
#include "scenes/scene/even_maps.h"
#include "scenes/scene/scene.h"

// Used for maps that the folder lacks.
static const float default_grey = 0.5f, default_roughness = 0.5f;

// Files do not state the depth of their relief. This value is common for stone; used if no normal
// map determines it.
static const float default_height_scale = 0.05f;

typedef struct material_folder {
    const char *path;
    const lobe_host *host;
    material_files files;
    lobe_scene *scene;
    lobe_material material;
} material_folder;

static lobe_result out_of_memory(const material_folder *folder) {
    return lobe_host_fail(folder->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                          folder->path);
}

static const material_source *source_of(const material_folder *folder, material_map map) {
    return &folder->files.sources[map];
}

static bool has(const material_folder *folder, material_map map) {
    return source_of(folder, map)->file != NULL;
}

// "FOLDER/FILE"; the caller frees it with lobe_release. NULL if out of memory.
static char *file_path(const material_folder *folder, const material_file *file) {
    const size_t size = strlen(folder->path) + strlen(file->name) + 2;
    char *path = lobe_allocate(lobe_host_allocator(folder->host), size, 1);
    if (path)
        snprintf(path, size, "%s/%s", folder->path, file->name);
    return path;
}

// Loads the file of a map; without one, `image` stays empty.
static lobe_result load(const material_folder *folder, material_map map, scene_image_use use,
                        lobe_image *image) {
    *image = (lobe_image){0};
    if (!has(folder, map))
        return LOBE_OK;
    char *path = file_path(folder, source_of(folder, map)->file);
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
    if (status || !image.texels)
        return status;
    return attach(folder, source_of(folder, map)->file->name, &image, use);
}

static lobe_result add_normals(material_folder *folder) {
    material_map map =
        has(folder, MATERIAL_MAP_NORMAL) ? MATERIAL_MAP_NORMAL : MATERIAL_MAP_NORMAL_DIRECTX;
    lobe_image image;
    lobe_result status = load(folder, map, SCENE_IMAGE_DATA, &image);
    if (status || !image.texels)
        return status;
    if (map == MATERIAL_MAP_NORMAL_DIRECTX)
        scenes_image_channel_invert(&image, 1);
    return attach(folder, source_of(folder, map)->file->name, &image, &folder->material.normal_map);
}

static float find_height_scale(const material_folder *folder, const lobe_image *heights) {
    int32_t normals = folder->material.normal_map.image;
    float scale = default_height_scale;
    if (normals >= 0)
        scenes_height_scale_find(heights, &folder->scene->images[normals].image, &scale);
    return scale;
}

// Takes a channel out of a packed image, to all channels of a new one.
static lobe_result unpack(const material_folder *folder, const material_source *source,
                          lobe_image *image) {
    if (!scenes_material_file_is_packed(&source->file->content))
        return LOBE_OK;
    lobe_image packed = *image;
    const image_channel value = {.image = &packed, .channel = source->channel};
    const image_channel channels[4] = {value, value, value, {.value = 1}};
    lobe_result status =
        scenes_image_channel_pack(channels, source->file->name, folder->host, image);
    lobe_image_free(&packed);
    return status;
}

// A map that stands on its own, in the red channel.
static lobe_result load_value(const material_folder *folder, material_map map, lobe_image *image) {
    lobe_result status = load(folder, map, SCENE_IMAGE_DATA, image);
    return status || !image->texels ? status : unpack(folder, source_of(folder, map), image);
}

static lobe_result add_heights(material_folder *folder) {
    lobe_image image;
    lobe_result status = load_value(folder, MATERIAL_MAP_DISPLACEMENT, &image);
    if (status || !image.texels)
        return status;
    folder->material.height_scale = find_height_scale(folder, &image);
    return attach(folder, source_of(folder, MATERIAL_MAP_DISPLACEMENT)->file->name, &image,
                  &folder->material.height_map);
}

static lobe_result add_occlusion(material_folder *folder) {
    lobe_image image;
    if (folder->material.occlusion_map.image >= 0)
        return LOBE_OK;
    lobe_result status = load_value(folder, MATERIAL_MAP_OCCLUSION, &image);
    if (status || !image.texels)
        return status;
    return attach(folder, source_of(folder, MATERIAL_MAP_OCCLUSION)->file->name, &image,
                  &folder->material.occlusion_map);
}

// ---------------------------------------------------------------------------------------------
// Roughness and metallic

// One image with roughness and metallic in the channels that glTF defines, and perhaps occlusion.
static lobe_result add_gltf_channels(material_folder *folder) {
    lobe_material *material = &folder->material;
    const material_source *source = source_of(folder, MATERIAL_MAP_ROUGHNESS);
    lobe_image image;
    lobe_result status = load(folder, MATERIAL_MAP_ROUGHNESS, SCENE_IMAGE_DATA, &image);
    if (!status)
        status = attach(folder, source->file->name, &image, &material->metallic_roughness_map);
    if (!status && source_of(folder, MATERIAL_MAP_OCCLUSION)->file == source->file)
        material->occlusion_map = material->metallic_roughness_map;
    material->roughness = material->metallic = 1;
    return status;
}

// The images of roughness and metallic, which may be channels of one file.
typedef struct value_images {
    lobe_image roughness, metallic;
} value_images;

static lobe_result load_values(const material_folder *folder, material_map roughness,
                               value_images *images) {
    lobe_result status = load(folder, roughness, SCENE_IMAGE_DATA, &images->roughness);
    if (!status)
        status = load(folder, MATERIAL_MAP_METALLIC, SCENE_IMAGE_DATA, &images->metallic);
    const material_source *source = source_of(folder, roughness);
    // Smoothness belongs into alpha: without any, the file holds none.
    if (!status && images->roughness.texels && source->channel == 3 &&
        scenes_image_channel_is_full(&images->roughness, 3)) {
        lobe_host_log(folder->host, LOBE_LOG_WARNING,
                      "%s/%s: has no alpha, and so no smoothness; roughness is %g", folder->path,
                      source->file->name, (double)default_roughness);
        lobe_image_free(&images->roughness);
    }
    return status;
}

// Images, or channels of images, packed into one as glTF does.
static lobe_result pack_values(material_folder *folder) {
    lobe_material *material = &folder->material;
    const material_map map =
        has(folder, MATERIAL_MAP_ROUGHNESS) ? MATERIAL_MAP_ROUGHNESS : MATERIAL_MAP_GLOSS;
    value_images images = {0};
    lobe_image packed = {0};
    lobe_result status = load_values(folder, map, &images);
    const image_channel channels[4] = {
        {.value = 1},
        {&images.roughness, source_of(folder, map)->channel, 1, map == MATERIAL_MAP_GLOSS},
        {&images.metallic, source_of(folder, MATERIAL_MAP_METALLIC)->channel, 1, false},
        {.value = 1}};
    const bool any = images.roughness.texels || images.metallic.texels;
    if (!status && any)
        status = scenes_image_channel_pack(channels, folder->path, folder->host, &packed);
    if (!status && any)
        status = attach(folder, "metallic-roughness", &packed, &material->metallic_roughness_map);
    material->roughness = images.roughness.texels ? 1 : default_roughness;
    if (images.metallic.texels)
        material->metallic = 1;
    lobe_image_free(&images.roughness);
    lobe_image_free(&images.metallic);
    return status;
}

static lobe_result add_roughness_and_metallic(material_folder *folder) {
    folder->material.roughness = default_roughness;
    // If nothing is known about the material, metal is assumed, because it shows the relief of a
    // grey surface best.
    folder->material.metallic = has(folder, MATERIAL_MAP_ALBEDO) ? 0 : 1;
    const material_source *roughness = source_of(folder, MATERIAL_MAP_ROUGHNESS);
    const material_source *metallic = source_of(folder, MATERIAL_MAP_METALLIC);
    if (roughness->file && roughness->file == metallic->file &&
        scenes_material_file_is_gltf(&roughness->file->content))
        return add_gltf_channels(folder);
    if (roughness->file || metallic->file || has(folder, MATERIAL_MAP_GLOSS))
        return pack_values(folder);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------

static lobe_result add_material(material_folder *folder) {
    lobe_material *material = &folder->material;
    lobe_material_default(material);
    if (!has(folder, MATERIAL_MAP_ALBEDO))
        for (int channel = 0; channel < 3; channel++)
            material->base_colour[channel] = default_grey;
    if (has(folder, MATERIAL_MAP_EMISSIVE))
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

lobe_result scenes_material_open(const lobe_scene_open_parameters *parameters, lobe_carrier carrier,
                                 const lobe_host *host, lobe_scene **result) {
    material_folder folder = {.path = parameters->scene, .host = host};
    lobe_result status = scenes_material_files_find(folder.path, host, &folder.files);
    if (!status)
        status = scenes_allocate(folder.path, host, &folder.scene);
    if (!status)
        status = add_material(&folder);
    if (!status)
        status = scenes_carrier_add(folder.scene, carrier, host);
    if (!status)
        status = scenes_fold_even_maps(folder.scene, host);
    if (!status)
        status = scenes_complete(folder.scene, parameters->own_light_only, host);
    if (!status)
        scenes_carrier_turn_light(folder.scene, carrier);
    scenes_material_files_free(&folder.files);
    if (status)
        lobe_scene_destroy(&folder.scene);
    *result = folder.scene;
    return status;
}
