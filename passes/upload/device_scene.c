#include "passes/upload/device_scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cglm/cglm.h>

#include "passes/filters/lobes/subdivision_choice.h"
#include "passes/upload/image_texel.h"
#include "passes/upload/scene_check.h"
#include "shaders/interface/vertex.h"

#define ONE_PLACE(member)                                                                          \
    static_assert(offsetof(struct vertex, member) == offsetof(lobe_scene_vertex, member),          \
                  "one vertex, two descriptions")

static_assert(sizeof(struct vertex) == sizeof(lobe_scene_vertex), "one vertex, two descriptions");
ONE_PLACE(position);
ONE_PLACE(normal);
ONE_PLACE(tangent);
ONE_PLACE(texture_coordinates);
ONE_PLACE(colour);

const lobe_texture_use *passes_device_scene_map(const lobe_scene *scene,
                                                const lobe_material *material, uint32_t map) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    const lobe_texture_use *use = NULL;
    switch (map) {
    case MAP_BASE_COLOUR:
        use = &material->base_colour_map;
        break;
    case MAP_NORMAL:
        use = &material->normal_map;
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
    }
    return use && use->image >= 0 ? use : NULL;
}

static float luminance(const float colour[3]) {
    return 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
}

float passes_material_lobe_share(const lobe_material *material, uint32_t lobe) {
    float sum = 0;
    for (uint32_t i = 0; i < material->lobe_count; ++i)
        sum += luminance(material->lobes[i].colour);
    return sum > 0 ? luminance(material->lobes[lobe].colour) / sum
                   : 1.0f / (float)material->lobe_count;
}

static void fill_lobes(const lobe_material *material, struct material_constants *constants) {
    for (uint32_t i = 0; i < material->lobe_count; ++i) {
        const lobe_base_lobe *lobe = &material->lobes[i];
        memcpy(constants->lobe_direction[i], lobe->direction, sizeof lobe->direction);
        constants->lobe_direction[i][3] = lobe->width;
        memcpy(constants->lobe_colour[i], lobe->colour, sizeof lobe->colour);
        constants->lobe_colour[i][3] = passes_material_lobe_share(material, i);
    }
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
    if (source->model == LOBE_MATERIAL_HALF_VECTOR_LOBES)
        fill_lobes(source, constants);
    for (uint32_t map = 0; map < MAP_COUNT; ++map) {
        for (int row = 0; material->maps[map].use && row < 2; ++row)
            memcpy(constants->transforms[2 * map + (uint32_t)row],
                   material->maps[map].use->transform[row],
                   sizeof material->maps[map].use->transform[row]);
    }
}

static lobe_result upload_image(lobe_device *device, device_scene *result, int32_t index,
                                const lobe_host *host) {
    if (result->images[index])
        return LOBE_OK;
    const lobe_scene_image *image = &result->scene->images[index];
    lobe_result status = passes_scene_check_image(result->scene, (size_t)index, host);
    if (status != LOBE_OK)
        return status;
    return lobe_texture_create(
        device, &(lobe_texture_parameters){.name = image->name, .image = &image->image},
        &result->images[index]);
}

static bool lobe_widths_differ(const lobe_material *material) {
    if (material->model == LOBE_MATERIAL_MICROFACET)
        return false;
    for (uint32_t i = 1; i < material->lobe_count; ++i) {
        if (material->lobes[i].width != material->lobes[0].width)
            return true;
    }
    return false;
}

/// Whether a metallic-roughness map has one metallic value; if so, gives it.
static bool metallic_is_constant(const lobe_image *image, float *metallic) {
    float first[4], texel[4];
    if (!passes_image_texel(image, 0, 0, first))
        return false;
    for (uint32_t y = 0; y < image->height; ++y) {
        for (uint32_t x = 0; x < image->width; ++x) {
            passes_image_texel(image, x, y, texel);
            if (texel[2] != first[2])
                return false;
        }
    }
    *metallic = first[2];
    return true;
}

static void measure_metallic(const lobe_scene *scene, device_material *material) {
    const lobe_texture_use *use = material->maps[MAP_WIDTH].use;
    float constant = 1;
    material->metallic = material->material->metallic;
    if (!use || material->material->model != LOBE_MATERIAL_MICROFACET || material->metallic == 0)
        return;
    if (metallic_is_constant(&scene->images[use->image].image, &constant))
        material->metallic *= constant;
    else
        material->metallic_varies = true;
}

static lobe_result find_maps(lobe_device *device, device_scene *result, device_material *material,
                             const lobe_host *host) {
    for (uint32_t map = 0; map < MAP_COUNT; ++map) {
        const lobe_texture_use *use =
            passes_device_scene_map(result->scene, material->material, map);
        if (!use)
            continue;
        lobe_result status = upload_image(device, result, use->image, host);
        if (status != LOBE_OK)
            return status;
        const lobe_image *image = &result->scene->images[use->image].image;
        material->maps[map] = (device_map){use, image->width, image->height};
        material->map_bits |= 1u << map;
        if (use->texture_coordinates)
            material->second_coordinates |= 1u << map;
    }
    return LOBE_OK;
}

static void forget_colours(struct material_constants *constants) {
    memset(constants->base_colour, 0, sizeof constants->base_colour);
    memset(constants->emissive, 0, sizeof constants->emissive);
    constants->metallic = 0;
    for (uint32_t i = 0; i < MATERIAL_MAXIMUM_LOBES; ++i)
        memset(constants->lobe_colour[i], 0, 3 * sizeof constants->lobe_colour[i][0]);
}

static lobe_result store(lobe_device *device, const char *name,
                         const struct material_constants *constants, lobe_buffer **buffer) {
    if (*buffer)
        return lobe_buffer_update(*buffer, constants);
    return lobe_buffer_create(
        device,
        &(lobe_buffer_parameters){.name = name, .size = sizeof *constants, .data = constants},
        buffer);
}

static lobe_result store_constants(lobe_device *device, device_material *material) {
    const char *name = material->material->name;
    struct material_constants constants;
    fill_constants(material, &constants);
    lobe_result status = store(device, name, &constants, &material->constants);
    forget_colours(&constants);
    bool same =
        material->map_constants && memcmp(&constants, &material->map_values, sizeof constants) == 0;
    material->map_values = constants;
    return status != LOBE_OK || same ? status
                                     : store(device, name, &constants, &material->map_constants);
}

lobe_result passes_device_scene_upload_material(lobe_device *device, device_scene *scene,
                                                uint32_t index, const lobe_host *host) {
    device_material *material = &scene->materials[index];
    // But for its buffers all is made anew.
    *material = (device_material){.material = &scene->scene->materials[index],
                                  .constants = material->constants,
                                  .map_constants = material->map_constants,
                                  .map_values = material->map_values};
    lobe_result status = find_maps(device, scene, material, host);
    if (status != LOBE_OK)
        return status;
    measure_metallic(scene->scene, material);
    material->widths_differ = lobe_widths_differ(material->material);
    if (material->maps[MAP_NORMAL].use || material->maps[MAP_WIDTH].use)
        material->subdivision = passes_subdivision_choose(scene->scene, material);
    return store_constants(device, material);
}

static lobe_result upload_material(lobe_device *device, device_scene *result, uint32_t index,
                                   const lobe_host *host) {
    if (result->materials[index].constants)
        return LOBE_OK;
    lobe_result status = passes_scene_check_material(result->scene, index, host);
    return status == LOBE_OK ? passes_device_scene_upload_material(device, result, index, host)
                             : status;
}

static lobe_result upload_mesh(lobe_device *device, device_scene *result, uint32_t index,
                               const lobe_host *host) {
    if (result->vertices[index])
        return LOBE_OK;
    lobe_result status = passes_scene_check_mesh(result->scene, index, host);
    return status == LOBE_OK ? passes_device_scene_upload_mesh(device, result, index) : status;
}

lobe_result passes_device_scene_upload_mesh(lobe_device *device, device_scene *scene,
                                            uint32_t index) {
    const lobe_mesh *mesh = &scene->scene->meshes[index];
    lobe_result status = lobe_buffer_create(
        device,
        &(lobe_buffer_parameters){.name = mesh->name,
                                  .size = mesh->vertex_count * sizeof *mesh->vertices,
                                  .data = mesh->vertices},
        &scene->vertices[index]);
    if (status != LOBE_OK)
        return status;
    scene->densities[index] = passes_mesh_density_measure(mesh);
    char name[128];
    snprintf(name, sizeof name, "indices of %s", mesh->name);
    return lobe_buffer_create(
        device,
        &(lobe_buffer_parameters){
            .name = name, .size = mesh->index_count * sizeof *mesh->indices, .data = mesh->indices},
        &scene->indices[index]);
}

static void transformed_coordinates(const lobe_texture_use *use, const lobe_scene_vertex *vertex,
                                    float uv[2]) {
    const float *set = vertex->texture_coordinates[use->texture_coordinates];
    for (int i = 0; i < 2; ++i)
        uv[i] =
            use->transform[i][0] * set[0] + use->transform[i][1] * set[1] + use->transform[i][2];
}

/// Whether a map's texels each belong to one place of the mesh: all coordinates within the map,
/// and triangles that do not cover more of it than there is.
static bool is_atlas(const lobe_mesh *mesh, const lobe_texture_use *use) {
    if (!mesh->has_texture_coordinates[use->texture_coordinates])
        return false;
    const float slack = 1e-3f;
    double area = 0;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        float uv[3][2];
        for (int corner = 0; corner < 3; ++corner) {
            transformed_coordinates(use, &mesh->vertices[mesh->indices[i + (size_t)corner]],
                                    uv[corner]);
            for (int axis = 0; axis < 2; ++axis) {
                if (uv[corner][axis] < -slack || uv[corner][axis] > 1 + slack)
                    return false;
            }
        }
        area += 0.5 * fabs((double)(uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) -
                           (double)(uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]));
    }
    return area <= 1 + 10 * slack;
}

static bool mirrors(const float transform[16]) {
    mat4 matrix;
    memcpy(matrix, transform, sizeof matrix);
    mat3 linear;
    glm_mat4_pick3(matrix, linear);
    return glm_mat3_det(linear) < 0;
}

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether the linear part is a rotation or a reflection times a uniform scale: its columns are
/// equally long and at right angles.
static bool keeps_angles(const float transform[16]) {
    const float *x = transform, *y = transform + 4, *z = transform + 8;
    float square = dot(x, x), slack = 1e-3f * square;
    return fabsf(dot(y, y) - square) <= slack && fabsf(dot(z, z) - square) <= slack &&
           fabsf(dot(x, y)) <= slack && fabsf(dot(y, z)) <= slack && fabsf(dot(z, x)) <= slack;
}

lobe_result passes_device_scene_check_instance(const lobe_scene *scene, size_t index,
                                               const lobe_host *host) {
    const lobe_instance *instance = &scene->instances[index];
    if (instance->mesh < scene->mesh_count && instance->material < scene->material_count)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                          "%s: instance %zu uses mesh %u of %zu, material %u of %zu", scene->name,
                          index, instance->mesh, scene->mesh_count, instance->material,
                          scene->material_count);
}

void passes_device_scene_measure_instance(device_scene *scene, size_t index) {
    const lobe_instance *source = &scene->scene->instances[index];
    const device_material *material = &scene->materials[source->material];
    const lobe_texture_use *use = material->maps[MAP_NORMAL].use ? material->maps[MAP_NORMAL].use
                                                                 : material->maps[MAP_WIDTH].use;
    scene->instances[index] = (device_instance){
        .mesh = source->mesh,
        .material = source->material,
        .mirrored = mirrors(source->transform),
        .keeps_angles = keeps_angles(source->transform),
        .is_atlas = use && is_atlas(&scene->scene->meshes[source->mesh], use),
    };
}

lobe_result passes_device_scene_upload_instance(lobe_device *device, device_scene *scene,
                                                size_t index, const lobe_host *host) {
    const lobe_instance *source = &scene->scene->instances[index];
    lobe_result status = passes_device_scene_check_instance(scene->scene, index, host);
    if (status == LOBE_OK)
        status = upload_mesh(device, scene, source->mesh, host);
    if (status == LOBE_OK)
        status = upload_material(device, scene, source->material, host);
    if (status == LOBE_OK)
        passes_device_scene_measure_instance(scene, index);
    return status;
}

static lobe_result upload_white(lobe_device *device, device_scene *result) {
    uint8_t texel[4] = {255, 255, 255, 255};
    lobe_image image = {LOBE_FORMAT_RGBA8_UNORM, 1, 1, texel};
    return lobe_texture_create(device, &(lobe_texture_parameters){.name = "white", .image = &image},
                               &result->white);
}

lobe_result passes_device_scene_upload_environment(lobe_device *device, device_scene *result) {
    const lobe_environment *environment = result->scene->environment;
    if (!environment)
        return LOBE_OK;
    return lobe_texture_create(
        device, &(lobe_texture_parameters){.name = environment->name, .image = &environment->image},
        &result->environment);
}

static bool allocate_tables(device_scene *result) {
    const lobe_scene *scene = result->scene;
    result->images =
        lobe_allocate(result->allocator, scene->image_count + 1, sizeof *result->images);
    result->materials =
        lobe_allocate(result->allocator, scene->material_count + 1, sizeof *result->materials);
    result->vertices =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->vertices);
    result->indices =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->indices);
    result->densities =
        lobe_allocate(result->allocator, scene->mesh_count + 1, sizeof *result->densities);
    result->instances =
        lobe_allocate(result->allocator, scene->instance_count + 1, sizeof *result->instances);
    return result->images && result->materials && result->vertices && result->indices &&
           result->densities && result->instances;
}

lobe_result passes_device_scene_create(lobe_device *device, const lobe_scene *scene,
                                       const lobe_host *host, device_scene **result) {
    lobe_result status = LOBE_ERROR_OUT_OF_MEMORY;
    const lobe_allocator *allocator = lobe_device_allocator(device);
    *result = lobe_allocate(allocator, 1, sizeof **result);
    if (*result) {
        (*result)->scene = scene;
        (*result)->allocator = allocator;
    }
    if (!*result || !allocate_tables(*result)) {
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: out of memory", scene->name);
        goto fail;
    }
    if (scene->instance_count == 0) {
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: there is nothing to draw", scene->name);
        status = LOBE_ERROR_MALFORMED;
        goto fail;
    }
    status = upload_white(device, *result);
    if (status == LOBE_OK)
        status = passes_scene_check_environment(scene, host);
    if (status == LOBE_OK)
        status = passes_device_scene_upload_environment(device, *result);
    for (size_t i = 0; status == LOBE_OK && i < scene->instance_count; ++i)
        status = passes_device_scene_upload_instance(device, *result, i, host);
    if (status == LOBE_OK)
        return LOBE_OK;
fail:
    passes_device_scene_destroy(result);
    return status;
}

void passes_device_scene_destroy(device_scene **scene) {
    device_scene *s = scene ? *scene : NULL;
    if (!s)
        return;
    for (size_t i = 0; s->images && i < s->scene->image_count; ++i)
        lobe_texture_destroy(&s->images[i]);
    for (size_t i = 0; s->materials && i < s->scene->material_count; ++i) {
        lobe_buffer_destroy(&s->materials[i].constants);
        lobe_buffer_destroy(&s->materials[i].map_constants);
    }
    for (size_t i = 0; s->vertices && s->indices && i < s->scene->mesh_count; ++i) {
        lobe_buffer_destroy(&s->vertices[i]);
        lobe_buffer_destroy(&s->indices[i]);
    }
    lobe_texture_destroy(&s->white);
    lobe_texture_destroy(&s->environment);
    lobe_release(s->images);
    lobe_release(s->materials);
    lobe_release(s->vertices);
    lobe_release(s->indices);
    lobe_release(s->densities);
    lobe_release(s->instances);
    lobe_release(s);
    *scene = NULL;
}

lobe_resource passes_device_map_import(lobe_graph *graph, const device_scene *scene,
                                       const device_material *material, uint32_t map) {
    const lobe_texture_use *use = material->maps[map].use;
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
