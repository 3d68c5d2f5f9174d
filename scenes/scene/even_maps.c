#include "scenes/scene/even_maps.h"

#include <math.h>
#include <string.h>

#include <lobe/colour.h>

#include "scenes/material/image_channel.h"

// Bytes have no value for a slope of zero: 127 and 128 are as near as they come.
#define FLAT_TILT (1.001 / 255)

static bool is_even(const lobe_scene_image *image) {
    const unsigned char *texels = image->image.texels;
    if (image->on_device || !texels)
        return false;
    const size_t texel = lobe_format_size(image->image.format);
    const size_t size = texel * image->image.width * image->image.height;
    return memcmp(texels, texels + texel, size - texel) == 0;
}

/// Of the first texel; colours linear. False: of a format in which no file's images are.
static bool get_value(const lobe_image *image, double value[4]) {
    const bool encoded = image->format == LOBE_FORMAT_RGBA8_SRGB;
    if (!encoded && image->format != LOBE_FORMAT_RGBA8_UNORM &&
        image->format != LOBE_FORMAT_RGBA16_UNORM)
        return false;
    for (uint32_t i = 0; i < 4; i++) {
        value[i] = scenes_image_channel_value(image, 0, 0, i);
        if (encoded && i < 3)
            value[i] = (double)lobe_srgb_decode((float)value[i]);
    }
    return true;
}

/// The value of a map that has one.
static bool find_value(const lobe_scene *scene, const lobe_texture_use *use, double value[4]) {
    return use->image >= 0 && is_even(&scene->images[use->image]) &&
           get_value(&scene->images[use->image].image, value);
}

static bool is_flat(const double normal[4]) {
    return fabs(2 * normal[0] - 1) <= FLAT_TILT && fabs(2 * normal[1] - 1) <= FLAT_TILT &&
           normal[2] > 0.5;
}

static void scale(float *factors, const double *values, int count) {
    for (int i = 0; i < count; i++)
        factors[i] *= (float)values[i];
}

/// Takes a map away, and counts it.
static void take(lobe_texture_use *use, size_t *count) {
    *use = LOBE_TEXTURE_NONE;
    ++*count;
}

static size_t fold_maps(const lobe_scene *scene, lobe_material *material) {
    size_t count = 0;
    double value[4];
    if (find_value(scene, &material->base_colour_map, value)) {
        scale(material->base_colour, value, 4);
        take(&material->base_colour_map, &count);
    }
    if (find_value(scene, &material->metallic_roughness_map, value)) {
        scale(&material->roughness, value + 1, 1);
        scale(&material->metallic, value + 2, 1);
        take(&material->metallic_roughness_map, &count);
    }
    if (find_value(scene, &material->emissive_map, value)) {
        scale(material->emissive, value, 3);
        take(&material->emissive_map, &count);
    }
    if (find_value(scene, &material->normal_map, value) && is_flat(value) &&
        material->height_map.image < 0)
        take(&material->normal_map, &count);
    if (find_value(scene, &material->occlusion_map, value) && value[0] == 1)
        take(&material->occlusion_map, &count);
    return count;
}

static bool is_posed(const lobe_scene *scene, size_t material) {
    for (size_t i = 0; scene->rig && i < scene->rig->material_count; i++)
        if (scene->rig->materials[i].material == (int32_t)material)
            return true;
    return false;
}

static bool has_heights(const lobe_scene *scene, size_t image) {
    for (size_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].height_map.image == (int32_t)image)
            return true;
    return false;
}

static lobe_result shrink(lobe_image *image, const lobe_host *host) {
    lobe_image single;
    const lobe_result result = lobe_image_allocate(&single, image->format, 1, 1, host);
    if (result != LOBE_OK)
        return result;
    memcpy(single.texels, image->texels, lobe_format_size(image->format));
    lobe_image_free(image);
    *image = single;
    return LOBE_OK;
}

lobe_result scenes_fold_even_maps(lobe_scene *scene, const lobe_host *host) {
    lobe_result result = LOBE_OK;
    size_t count = 0;
    for (size_t i = 0; result == LOBE_OK && i < scene->image_count; i++)
        if (is_even(&scene->images[i]) && !has_heights(scene, i))
            result = shrink(&scene->images[i].image, host);
    for (size_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].model == LOBE_MATERIAL_MICROFACET && !is_posed(scene, i))
            count += fold_maps(scene, &scene->materials[i]);
    if (result == LOBE_OK && count > 0)
        lobe_host_log(host, LOBE_LOG_NOTICE,
                      "%s: %zu map%s the same value in all texels: taken as the material's numbers",
                      scene->name, count, count == 1 ? " has" : "s have");
    return result;
}
