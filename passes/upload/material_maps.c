#include "passes/upload/material_maps.h"

#include <lobe/colour.h>
#include <math.h>
#include <string.h>

bool passes_has_height_normals(const lobe_scene *scene, const lobe_material *material) {
    const int32_t index = material->height_map.image;
    double height;
    if (material->normal_map.image >= 0 || index < 0 || material->height_scale == 0)
        return false;
    const lobe_scene_image *image = &scene->images[index];
    return !image->on_device && image->image.width > 0 && image->image.height > 0 &&
           passes_height_texel(&image->image, 0, 0, &height);
}

const lobe_texture_use *passes_material_map_use(const lobe_scene *scene,
                                                const lobe_material *material, uint32_t map) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    const lobe_texture_use *use = NULL;
    switch (map) {
    case MAP_BASE_COLOUR:
        use = &material->base_colour_map;
        break;
    case MAP_NORMAL:
        use = passes_has_height_normals(scene, material) ? &material->height_map
                                                         : &material->normal_map;
        break;
    case MAP_WIDTH:
        use = microfacet ? &material->metallic_roughness_map : &material->width_map;
        break;
    case MAP_SPECULAR:
        use = microfacet ? NULL : &material->specular_map;
        break;
    case MAP_EMISSIVE:
        use = &material->emissive_map;
        break;
    case MAP_OCCLUSION:
        use = scene->environment && material->occlusion_strength > 0 ? &material->occlusion_map
                                                                     : NULL;
        break;
    case MAP_HEIGHT:
        use = material->height_scale != 0 ? &material->height_map : NULL;
        break;
    }
    return use && use->image >= 0 ? use : NULL;
}

uint32_t passes_second_coordinates(const device_material *material) {
    return material->equal_sets ? 0 : material->second_coordinates;
}

bool passes_heights_have_own_set(const device_material *material) {
    const lobe_texture_use *heights = material->maps[MAP_HEIGHT].use;
    const lobe_texture_use *normals = &material->material->normal_map;
    const uint32_t followed = normals->image >= 0 ? normals->texture_coordinates : 0;
    return heights && !material->equal_sets && heights->texture_coordinates != followed;
}

lobe_resource passes_device_map_import(lobe_graph *graph, const device_scene *scene,
                                       const device_material *material, uint32_t map) {
    const lobe_texture_use *use = material->maps[map].use;
    if (map == MAP_NORMAL && material->height_normals)
        return lobe_graph_import_texture(graph, material->height_normals);
    if (use && scene->scene->images[use->image].on_device)
        return scene->given[use->image];
    return lobe_graph_import_texture(graph, use ? scene->images[use->image] : scene->white);
}

static lobe_wrap_mode wrap_mode(lobe_scene_wrap wrap) {
    switch (wrap) {
    case LOBE_SCENE_WRAP_MIRROR:
        return LOBE_WRAP_MIRROR;
    case LOBE_SCENE_WRAP_CLAMP:
        return LOBE_WRAP_CLAMP;
    default:
        return LOBE_WRAP_REPEAT;
    }
}

lobe_sampler passes_device_map_sampler(const device_material *material, uint32_t map) {
    const lobe_texture_use *use = material->maps[map].use;
    if (!use)
        return (lobe_sampler){0};
    return (lobe_sampler){
        .texels = use->nearest ? LOBE_SAMPLE_NEAREST : LOBE_SAMPLE_LINEAR,
        .wrap_u = wrap_mode(use->wrap_u),
        .wrap_v = wrap_mode(use->wrap_v),
    };
}

bool passes_specular_colour_varies(const device_material *material) {
    if (material->material->model != LOBE_MATERIAL_MICROFACET)
        return material->maps[MAP_SPECULAR].use != NULL;
    return material->metallic_varies ||
           (material->metallic > 0 && material->maps[MAP_BASE_COLOUR].use);
}

bool passes_device_map_has_texels(const device_map *map) {
    return map->use && map->width * map->height > 1;
}

bool passes_device_map_is_interpolated(const device_material *material, uint32_t index) {
    const device_map *map = &material->maps[index];
    return passes_device_map_has_texels(map) && !map->use->nearest;
}

/// `sets`: bit MAP_...: the map is read by the second set.
static bool share_coordinates(const device_material *material, uint32_t a, uint32_t b,
                              uint32_t sets) {
    const lobe_texture_use *first = material->maps[a].use, *second = material->maps[b].use;
    const bool wrap_alike = first->wrap_u == second->wrap_u && first->wrap_v == second->wrap_v;
    return (sets >> a & 1) == (sets >> b & 1) &&
           memcmp(first->transform, second->transform, sizeof first->transform) == 0 &&
           (wrap_alike || (material->inside >> a & material->inside >> b & 1) != 0);
}

static bool widths_lie_apart(const device_material *material, uint32_t second_coordinates) {
    return material->material->model == LOBE_MATERIAL_MICROFACET &&
           passes_device_map_has_texels(&material->maps[MAP_NORMAL]) &&
           passes_device_map_has_texels(&material->maps[MAP_WIDTH]) &&
           !share_coordinates(material, MAP_NORMAL, MAP_WIDTH, second_coordinates);
}

bool passes_widths_lie_apart(const device_material *material) {
    return widths_lie_apart(material, passes_second_coordinates(material));
}

bool passes_widths_may_lie_apart(const device_material *material) {
    device_material anywhere = *material;
    anywhere.inside = 0;
    return widths_lie_apart(&anywhere, material->second_coordinates);
}

lobe_grid passes_lobe_grid(const device_material *material) {
    const device_map *normal = &material->maps[MAP_NORMAL], *widths = &material->maps[MAP_WIDTH];
    const uint32_t map = normal->use ? MAP_NORMAL : MAP_WIDTH;
    if (passes_widths_lie_apart(material))
        widths = normal;
    return (lobe_grid){
        .map = map,
        .use = material->maps[map].use,
        .width = normal->width > widths->width ? normal->width : widths->width,
        .height = normal->height > widths->height ? normal->height : widths->height,
    };
}

bool passes_lobe_grid_varies(const lobe_grid *grid) {
    return grid->width * grid->height > 1;
}

bool passes_maps_share_coordinates(const device_material *material, uint32_t a, uint32_t b) {
    return share_coordinates(material, a, b, passes_second_coordinates(material));
}

bool passes_lobe_grid_shares_coordinates(const device_material *material, uint32_t map) {
    const lobe_grid grid = passes_lobe_grid(material);
    return grid.use && passes_maps_share_coordinates(material, map, grid.map);
}

bool passes_lobes_are_masked(const device_material *material) {
    const device_map *mask = &material->maps[MAP_BASE_COLOUR];
    return material->masked && mask->use && mask->width * mask->height > 1 &&
           passes_lobe_grid_shares_coordinates(material, MAP_BASE_COLOUR);
}

bool passes_mask_cuts_texels(const device_material *material) {
    const device_map *mask = &material->maps[MAP_BASE_COLOUR];
    const lobe_grid grid = passes_lobe_grid(material);
    return passes_lobes_are_masked(material) &&
           (passes_device_map_is_interpolated(material, MAP_BASE_COLOUR) ||
            passes_device_map_is_interpolated(material, MAP_NORMAL) ||
            passes_device_map_is_interpolated(material, MAP_WIDTH) ||
            grid.width % mask->width != 0 || grid.height % mask->height != 0);
}

bool passes_lies_under_lobes(const device_material *material, uint32_t map) {
    const lobe_grid grid = passes_lobe_grid(material);
    const device_map *own = &material->maps[map];
    return !own->use || (own->width <= grid.width && own->height <= grid.height &&
                         passes_lobe_grid_shares_coordinates(material, map));
}

bool passes_colours_lie_under_lobes(const device_material *material) {
    return passes_lies_under_lobes(material, MAP_BASE_COLOUR) &&
           passes_lies_under_lobes(material, MAP_SPECULAR) &&
           passes_lies_under_lobes(material, MAP_WIDTH);
}

static float channel(const lobe_image *image, const unsigned char *texel, uint32_t index) {
    uint16_t word;
    float number;
    switch (image->format) {
    case LOBE_FORMAT_R8_UNORM:
    case LOBE_FORMAT_RG8_UNORM:
    case LOBE_FORMAT_RGBA8_UNORM:
        return (float)texel[index] / 255.0f;
    case LOBE_FORMAT_RG8_SNORM:
    case LOBE_FORMAT_RGBA8_SNORM:
        return fmaxf((float)(int8_t)texel[index] / 127.0f, -1);
    case LOBE_FORMAT_RG16_UNORM:
    case LOBE_FORMAT_RGBA16_UNORM:
        memcpy(&word, texel + 2 * index, sizeof word);
        return (float)word / 65535.0f;
    case LOBE_FORMAT_RG16_SNORM:
    case LOBE_FORMAT_RGBA16_SNORM:
        memcpy(&word, texel + 2 * index, sizeof word);
        return fmaxf((float)(int16_t)word / 32767.0f, -1);
    default:
        memcpy(&number, texel + 4 * index, sizeof number);
        return number;
    }
}

static bool is_readable(lobe_format format) {
    switch (format) {
    case LOBE_FORMAT_R8_UNORM:
    case LOBE_FORMAT_RG8_UNORM:
    case LOBE_FORMAT_RGBA8_UNORM:
    case LOBE_FORMAT_RG8_SNORM:
    case LOBE_FORMAT_RGBA8_SNORM:
    case LOBE_FORMAT_RG16_UNORM:
    case LOBE_FORMAT_RG16_SNORM:
    case LOBE_FORMAT_RGBA16_UNORM:
    case LOBE_FORMAT_RGBA16_SNORM:
    case LOBE_FORMAT_R32_FLOAT:
    case LOBE_FORMAT_RG32_FLOAT:
    case LOBE_FORMAT_RGBA32_FLOAT:
        return true;
    default:
        return false;
    }
}

bool passes_image_texel(const lobe_image *image, uint32_t x, uint32_t y, float value[4]) {
    if (!image->texels || !is_readable(image->format))
        return false;
    const unsigned char *texel = (const unsigned char *)image->texels +
                                 ((size_t)y * image->width + x) * lobe_format_size(image->format);
    for (uint32_t i = 0; i < 4; i++)
        value[i] = i < lobe_format_channels(image->format) ? channel(image, texel, i)
                                                           : (i == 3 ? 1.0f : 0.0f);
    return true;
}

/// Formats that only heights and colours have.
static const unsigned char *height_bytes(const lobe_image *image, uint32_t x, uint32_t y) {
    switch (image->texels ? image->format : LOBE_FORMAT_NONE) {
    case LOBE_FORMAT_RGBA8_SRGB:
    case LOBE_FORMAT_BGRA8_SRGB:
    case LOBE_FORMAT_BGRA8_UNORM:
        return (const unsigned char *)image->texels + 4 * ((size_t)y * image->width + x);
    default:
        return NULL;
    }
}

bool passes_height_texel(const lobe_image *image, uint32_t x, uint32_t y, double *height) {
    const unsigned char *bytes = height_bytes(image, x, y);
    float value[4];
    if (!bytes && !passes_image_texel(image, x, y, value))
        return false;
    if (bytes)
        value[0] = (float)bytes[image->format == LOBE_FORMAT_RGBA8_SRGB ? 0 : 2] / 255;
    if (bytes && image->format != LOBE_FORMAT_BGRA8_UNORM)
        value[0] = lobe_srgb_decode(value[0]);
    *height = value[0] > 0 ? fmin((double)value[0], 1) : 0;
    return true;
}

bool passes_normals_are_signed(lobe_normal_encoding encoding) {
    return encoding == LOBE_NORMALS_SIGNED || encoding == LOBE_NORMALS_SIGNED_XY;
}

bool passes_normals_lack_z(lobe_normal_encoding encoding) {
    return encoding == LOBE_NORMALS_UNSIGNED_XY || encoding == LOBE_NORMALS_SIGNED_XY;
}

static bool lie_alike(const struct material_constants *constants, uint32_t a, uint32_t b) {
    return memcmp(constants->transforms[2 * a], constants->transforms[2 * b],
                  2 * sizeof constants->transforms[0]) == 0;
}

void passes_map_places_forget(struct material_constants *constants) {
    static const uint32_t of_lobes[] = {MAP_NORMAL, MAP_WIDTH, MAP_BASE_COLOUR, MAP_SPECULAR};
    enum { COUNT = sizeof of_lobes / sizeof *of_lobes };
    float first_alike[COUNT];
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t first = 0;
        while (!lie_alike(constants, of_lobes[first], of_lobes[i]))
            ++first;
        first_alike[i] = (float)first;
    }
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (map != MAP_HEIGHT)
            memset(constants->transforms[2 * map], 0, 2 * sizeof constants->transforms[0]);
    for (uint32_t i = 0; i < COUNT; i++)
        constants->transforms[2 * of_lobes[i]][0] = first_alike[i];
}
