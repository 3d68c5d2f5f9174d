#include "passes/upload/device_scene_parts.h"

#include <math.h>
#include <string.h>

#include "passes/upload/heights/height_normals.h"
#include "passes/upload/material_lobes.h"
#include "passes/upload/material_maps.h"
#include "passes/upload/scene_check.h"

static void fill_lobes(const lobe_material *material, struct material_constants *constants) {
    for (uint32_t i = 0; i < material->lobe_count; i++) {
        const lobe_base_lobe *lobe = &material->lobes[i];
        memcpy(constants->lobe_direction[i], lobe->direction, sizeof lobe->direction);
        constants->lobe_direction[i][3] = lobe->width;
        memcpy(constants->lobe_colour[i], lobe->colour, sizeof lobe->colour);
        constants->lobe_colour[i][3] = passes_material_lobe_share(material, i);
    }
}

static float largest_colour(const lobe_material *material) {
    const bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    float largest = 1;
    for (int i = 0; i < 3; i++) {
        largest = fmaxf(largest, material->base_colour[i]);
        for (uint32_t k = 0; !microfacet && k < material->lobe_count; k++)
            largest = fmaxf(largest, material->lobes[k].colour[i] /
                                         fmaxf(passes_material_lobe_share(material, k), 1e-6f));
    }
    return largest;
}

static void fill_constants(const device_material *material, struct material_constants *constants) {
    const lobe_material *source = material->material;
    memset(constants, 0, sizeof *constants);
    memcpy(constants->base_colour, source->base_colour, sizeof source->base_colour);
    memcpy(constants->emissive, source->emissive, sizeof source->emissive);
    constants->emissive[3] = source->alpha_cutoff;
    constants->metallic = material->metallic;
    constants->roughness = source->roughness;
    constants->normal_scale = source->normal_scale;
    constants->normal_concentration = source->normal_concentration;
    constants->occlusion_strength = source->occlusion_strength;
    constants->largest_colour = largest_colour(source);
    constants->width_factor = material->width_factor;
    if (source->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        fill_lobes(source, constants);
    for (uint32_t map = 0; map < MAP_COUNT; map++) {
        for (int row = 0; material->maps[map].use && row < 2; row++)
            memcpy(constants->transforms[2 * map + (uint32_t)row],
                   material->maps[map].use->transform[row],
                   sizeof material->maps[map].use->transform[row]);
    }
}

lobe_result passes_device_scene_upload_image(device_scene *result, int32_t index,
                                             const lobe_host *host) {
    if (result->images[index])
        return LOBE_OK;
    const lobe_scene_image *image = &result->scene->images[index];
    lobe_result status = passes_scene_check_image(result->scene, (size_t)index, NULL, host);
    if (status != LOBE_OK || image->on_device)
        return status;
    return lobe_graph_create_texture(
        result->graph, &(lobe_texture_parameters){.name = image->name, .image = &image->image},
        &result->images[index]);
}

lobe_result passes_device_scene_upload_heights(device_scene *scene, const lobe_host *host) {
    lobe_result status = LOBE_OK;
    for (size_t i = 0; status == LOBE_OK && i < scene->scene->material_count; i++) {
        const lobe_texture_use *use = scene->materials[i].maps[MAP_HEIGHT].use;
        if (use)
            status = passes_device_scene_upload_image(scene, use->image, host);
    }
    return status;
}

/// Whether a row has the same bytes in a channel as another texel. Without branches, for compilers
/// to vectorise.
static bool row_equals(const unsigned char *row, uint32_t width, size_t texel, size_t channel,
                       const unsigned char *other) {
    unsigned different = 0;
    for (size_t byte = 0; byte < channel; byte++)
        for (size_t x = 0; x < width; x++)
            different |= (unsigned)(row[x * texel + byte] ^ other[byte]);
    return different == 0;
}

static image_channel measure_channel(const lobe_scene_image *source, uint32_t index) {
    const lobe_image *image = &source->image;
    const size_t texel = lobe_format_size(image->format);
    const uint32_t channels = lobe_format_channels(image->format);
    float first[4];
    if (source->on_device || !passes_image_texel(image, 0, 0, first))
        return (image_channel){.known = true, .varies = true};
    const size_t channel = texel / channels;
    const unsigned char *values = (const unsigned char *)image->texels + index * channel;
    for (size_t y = 0; channels > index && y < image->height; y++)
        if (!row_equals(values + y * image->width * texel, image->width, texel, channel, values))
            return (image_channel){.known = true, .varies = true};
    return (image_channel){.known = true, .value = first[index]};
}

/// Channel `index` of an image. Materials that share a map share what is known of it.
static image_channel find_channel(const device_scene *scene, int32_t image, uint32_t index) {
    image_channel *channel = &scene->channels[image].of[index];
    if (!channel->known)
        *channel = measure_channel(&scene->scene->images[image], index);
    return *channel;
}

/// Finds where the material is metal.
static void find_metal(const device_scene *scene, device_material *material) {
    const lobe_texture_use *use = material->maps[MAP_WIDTH].use;
    material->metallic = material->material->metallic;
    if (!use || material->material->model != LOBE_MATERIAL_MICROFACET || material->metallic == 0)
        return;
    const image_channel metal = find_channel(scene, use->image, 2);
    material->metallic_varies = metal.varies;
    if (!metal.varies)
        material->metallic *= metal.value;
}

/// Finds whether its base lobes differ in width. They may from some change of texels on: then maps
/// would have other layers, so that the host's handles would not be kept.
static void find_widths(const device_scene *scene, device_material *material) {
    const bool microfacets = material->material->model == LOBE_MATERIAL_MICROFACET;
    const lobe_texture_use *use = material->maps[MAP_WIDTH].use;
    material->widths_vary =
        passes_device_map_has_texels(&material->maps[MAP_WIDTH]) &&
        (!microfacets || material->material->roughness > 0) &&
        (scene->keeps_conclusions || find_channel(scene, use->image, microfacets ? 1 : 0).varies);
}

/// Finds a factor of roughness that stands for a width map which lies apart: bins of lobes are
/// fitted to lobes as wide as most are. A few thousand of its texels tell enough.
static void find_width_factor(device_material *material) {
    enum { SIDE = 64 };
    const device_map *map = &material->maps[MAP_WIDTH];
    double sum = 0;
    material->width_factor = 1;
    if (!map->readable || !passes_widths_may_lie_apart(material))
        return;
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        float texel[4];
        const uint32_t x = (2 * (i % SIDE) + 1) * map->width / (2 * SIDE);
        const uint32_t y = (2 * (i / SIDE) + 1) * map->height / (2 * SIDE);
        if (!passes_image_texel(map->texels, x, y, texel))
            return;
        sum += fmin(fmax((double)texel[1], 0), 1);
    }
    material->width_factor = (float)(sum / (SIDE * SIDE));
}

/// Makes the normals of the material's height map, and their texture.
static lobe_result make_height_normals(device_scene *scene, device_material *material,
                                       const lobe_host *host) {
    const lobe_material *source = material->material;
    const lobe_scene_image *heights = &scene->scene->images[source->height_map.image];
    lobe_image_free(&material->height_normal_texels);
    lobe_result status =
        passes_scene_check_image(scene->scene, (size_t)source->height_map.image, NULL, host);
    if (status == LOBE_OK)
        status = passes_height_normals_make(heights, &source->height_map, source->height_scale,
                                            host, &material->height_normal_texels);
    if (status != LOBE_OK)
        return status;
    if (lobe_texture_takes(material->height_normals, &material->height_normal_texels))
        return lobe_texture_update(material->height_normals, &material->height_normal_texels);
    lobe_texture_destroy(&material->height_normals);
    return lobe_graph_create_texture(
        scene->graph,
        &(lobe_texture_parameters){.name = heights->name, .image = &material->height_normal_texels},
        &material->height_normals);
}

static void drop_height_normals(device_material *material) {
    lobe_texture_destroy(&material->height_normals);
    lobe_image_free(&material->height_normal_texels);
}

/// The image of a map on the device, and what is known of it.
static lobe_result upload_map(device_scene *scene, device_material *material, uint32_t map,
                              const lobe_texture_use *use, const lobe_host *host) {
    const bool derived =
        map == MAP_NORMAL && passes_has_height_normals(scene->scene, material->material);
    lobe_result status = LOBE_OK;
    if (derived)
        status = make_height_normals(scene, material, host);
    else if (map != MAP_HEIGHT) // what reads heights uploads them
        status = passes_device_scene_upload_image(scene, use->image, host);
    if (status != LOBE_OK)
        return status;
    const lobe_scene_image *source = &scene->scene->images[use->image];
    const lobe_image *image = derived ? &material->height_normal_texels : &source->image;
    float first[4];
    material->maps[map] =
        (device_map){.use = use,
                     .image = use->image,
                     .width = image->width,
                     .height = image->height,
                     .format = image->format,
                     .normals = derived ? LOBE_NORMALS_SIGNED_XY : source->normals,
                     .readable = passes_image_texel(image, 0, 0, first),
                     .texels = image};
    return LOBE_OK;
}

static lobe_result find_maps(device_scene *result, device_material *material,
                             const lobe_host *host) {
    for (uint32_t map = 0; map < MAP_COUNT; map++) {
        const lobe_texture_use *use =
            passes_material_map_use(result->scene, material->material, map);
        if (!use)
            continue;
        lobe_result status = upload_map(result, material, map, use, host);
        if (status != LOBE_OK)
            return status;
        material->map_bits |= 1u << map;
        if (use->texture_coordinates)
            material->second_coordinates |= 1u << map;
    }
    return LOBE_OK;
}

static void forget_nothing(struct material_constants *constants) {
    (void)constants;
}

/// What no filtered map depends on.
static void forget_unfiltered(struct material_constants *constants) {
    passes_map_places_forget(constants);
    memset(constants->emissive, 0, sizeof constants->emissive);
    constants->occlusion_strength = 0;
}

/// What no lobe depends on.
static void forget_paint(struct material_constants *constants) {
    forget_unfiltered(constants);
    memset(constants->base_colour, 0, sizeof constants->base_colour);
    constants->largest_colour = 0;
}

/// The same, and metal, which may follow from texels alone.
static void forget_paint_and_metal(struct material_constants *constants) {
    forget_paint(constants);
    constants->metallic = 0;
}

void passes_device_material_forget_colours(struct material_constants *constants) {
    forget_paint_and_metal(constants);
    for (uint32_t i = 0; i < MATERIAL_MAXIMUM_LOBES; i++)
        memset(constants->lobe_colour[i], 0, 3 * sizeof constants->lobe_colour[i][0]);
}

/// Whether two sets of constants are equal except for what `forget` clears.
static bool are_equal(const struct material_constants *a, const struct material_constants *b,
                      void (*forget)(struct material_constants *)) {
    struct material_constants left = *a, right = *b;
    forget(&left);
    forget(&right);
    return memcmp(&left, &right, sizeof left) == 0;
}

static lobe_result store(lobe_graph *graph, const char *name,
                         const struct material_constants *constants, lobe_buffer **buffer) {
    if (*buffer)
        return lobe_buffer_update(*buffer, constants);
    return lobe_graph_create_buffer(
        graph,
        &(lobe_buffer_parameters){.name = name, .size = sizeof *constants, .data = constants},
        buffer);
}

/// Writes constants to a buffer, less what `forget` clears, unless it has them already.
static lobe_result store_part(lobe_graph *graph, const device_material *material,
                              const struct material_constants *constants,
                              void (*forget)(struct material_constants *), lobe_buffer **buffer) {
    struct material_constants part = *constants;
    if (*buffer && are_equal(constants, &material->values, forget))
        return LOBE_OK;
    forget(&part);
    return store(graph, material->material->name, &part, buffer);
}

static lobe_result store_constants(lobe_graph *graph, device_material *material) {
    struct material_constants constants;
    fill_constants(material, &constants);
    lobe_result status =
        store_part(graph, material, &constants, forget_nothing, &material->constants);
    if (status == LOBE_OK)
        status =
            store_part(graph, material, &constants, forget_unfiltered, &material->colour_constants);
    if (status == LOBE_OK)
        status = store_part(graph, material, &constants, passes_device_material_forget_colours,
                            &material->map_constants);
    if (status == LOBE_OK)
        material->values = constants;
    return status;
}

static bool is_same_map(const device_map *a, const device_map *b) {
    return a->image == b->image && a->width == b->width && a->height == b->height &&
           a->format == b->format && a->normals == b->normals && a->readable == b->readable;
}

/// Whether the material has maps of the same kinds, and lobes of them that differ at most in
/// numbers.
static bool keeps_maps(const device_material *before, const device_material *after) {
    if (after->height_normals && before->height_scale != after->height_scale)
        return false;
    for (uint32_t map = 0; map < MAP_HEIGHT; map++)
        if (!is_same_map(&before->maps[map], &after->maps[map]))
            return false;
    return before->model == after->model && before->distribution == after->distribution &&
           before->lobe_count == after->lobe_count &&
           before->second_coordinates == after->second_coordinates;
}

/// Whether the material has the lobes that it had, apart from other texels in its maps.
static bool keeps_factors(const device_scene *scene, const device_material *before,
                          const device_material *after) {
    return are_equal(&before->values, &after->values,
                     scene->keeps_conclusions ? forget_paint_and_metal : forget_paint);
}

static void count_change(const device_scene *scene, const device_material *before,
                         device_material *material) {
    const bool same = before->version > 0 && keeps_maps(before, material);
    if (same && keeps_factors(scene, before, material))
        return;
    ++material->version;
    if (same)
        ++material->factor_version;
    else
        ++material->parameter_version;
}

lobe_result passes_device_scene_upload_material(device_scene *scene, uint32_t index,
                                                const lobe_host *host) {
    device_material *material = &scene->materials[index];
    const device_material before = *material;
    // Rebuild everything except the GPU buffers.
    const lobe_material *source = &scene->scene->materials[index];
    *material = (device_material){
        .material = source,
        .model = source->model,
        .distribution = source->distribution,
        .lobe_count = source->model == LOBE_MATERIAL_MICROFACET ? 1 : source->lobe_count,
        .constants = before.constants,
        .colour_constants = before.colour_constants,
        .map_constants = before.map_constants,
        .values = before.values,
        .height_normals = before.height_normals,
        .height_normal_texels = before.height_normal_texels,
        .height = source->height_map,
        .height_scale = source->height_scale,
        .equal_sets = before.equal_sets,
        .inside = before.inside,
        .masked = before.masked,
        .colours = before.colours,
        .version = before.version,
        .parameter_version = before.parameter_version,
        .factor_version = before.factor_version,
        .pose_version = before.pose_version};
    memcpy(material->texel_versions, before.texel_versions, sizeof before.texel_versions);
    if (!passes_has_height_normals(scene->scene, source))
        drop_height_normals(material);
    lobe_result status = find_maps(scene, material, host);
    if (status == LOBE_OK) {
        find_metal(scene, material);
        find_widths(scene, material);
        find_width_factor(material);
        status = store_constants(scene->graph, material);
    }
    if (status == LOBE_OK) {
        count_change(scene, &before, material);
    } else {
        ++material->version;
        ++material->parameter_version;
    }
    return status;
}
