#include "passes/upload/scene_check.h"

#include <math.h>

/// The bits of a channel's exponent, which are all set in infinities and NaN; 0 for formats without
/// an exponent.
static uint32_t exponent_bits(lobe_format format) {
    switch (format) {
    case LOBE_FORMAT_R16_FLOAT:
    case LOBE_FORMAT_RG16_FLOAT:
    case LOBE_FORMAT_RGBA16_FLOAT:
        return 0x7c00;
    case LOBE_FORMAT_R32_FLOAT:
    case LOBE_FORMAT_RG32_FLOAT:
    case LOBE_FORMAT_RGBA32_FLOAT:
        return 0x7f800000;
    default:
        return 0;
    }
}

lobe_result passes_scene_check_image(const lobe_scene *scene, size_t index, const lobe_host *host) {
    const lobe_image *image = &scene->images[index].image;
    uint32_t exponent = exponent_bits(image->format);
    size_t channels = lobe_format_channels(image->format);
    size_t count = exponent ? (size_t)image->width * image->height * channels : 0;
    const uint16_t *halves = image->texels;
    const uint32_t *singles = image->texels;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits = exponent == 0x7c00 ? halves[i] : singles[i];
        if ((bits & exponent) != exponent)
            continue;
        size_t texel = i / channels;
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: image '%s': texel %zu, %zu is not finite",
                      scene->name, scene->images[index].name, texel % image->width,
                      texel / image->width);
        return LOBE_ERROR_MALFORMED;
    }
    return LOBE_OK;
}

static bool all_finite(const lobe_scene_vertex *vertex) {
    const float *values = (const float *)vertex;
    for (size_t i = 0; i < sizeof *vertex / sizeof *values; i++) {
        if (!isfinite(values[i]))
            return false;
    }
    return true;
}

lobe_result passes_scene_check_mesh(const lobe_scene *scene, size_t index, const lobe_host *host) {
    const lobe_mesh *mesh = &scene->meshes[index];
    if (mesh->vertex_count == 0 || mesh->index_count < 3) {
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: mesh '%s' has no triangles", scene->name,
                      mesh->name);
        return LOBE_ERROR_MALFORMED;
    }
    for (size_t i = 0; i < mesh->index_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count) {
            lobe_host_log(host, LOBE_LOG_ERROR, "%s: mesh '%s': index %zu is vertex %u of %zu",
                          scene->name, mesh->name, i, mesh->indices[i], mesh->vertex_count);
            return LOBE_ERROR_MALFORMED;
        }
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (!all_finite(&mesh->vertices[i])) {
            lobe_host_log(host, LOBE_LOG_ERROR, "%s: mesh '%s': vertex %zu is not finite",
                          scene->name, mesh->name, i);
            return LOBE_ERROR_MALFORMED;
        }
    }
    return LOBE_OK;
}

static lobe_result check_texture(const lobe_scene *scene, const char *material,
                                 const lobe_texture_use *use, const lobe_host *host) {
    if (use->image < 0)
        return LOBE_OK;
    if ((size_t)use->image >= scene->image_count) {
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: material '%s' uses image %d of %zu", scene->name,
                      material, use->image, scene->image_count);
        return LOBE_ERROR_MALFORMED;
    }
    if (use->texture_coordinates > 1) {
        lobe_host_log(host, LOBE_LOG_ERROR,
                      "%s: material '%s' uses set %u of texture coordinates; there are 0 and 1",
                      scene->name, material, use->texture_coordinates);
        return LOBE_ERROR_MALFORMED;
    }
    return LOBE_OK;
}

lobe_result passes_scene_check_material(const lobe_scene *scene, size_t index,
                                        const lobe_host *host) {
    const lobe_material *material = &scene->materials[index];
    const lobe_texture_use *uses[] = {
        &material->base_colour_map, &material->normal_map,
        &material->emissive_map,    &material->metallic_roughness_map,
        &material->width_map,       &material->specular_map,
        &material->height_map,
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        lobe_result result = check_texture(scene, material->name, uses[i], host);
        if (result != LOBE_OK)
            return result;
    }
    bool counted =
        material->model == LOBE_MATERIAL_MICROFACET ||
        (material->lobe_count >= 1 && material->lobe_count <= LOBE_MATERIAL_MAXIMUM_LOBES);
    if (counted)
        return LOBE_OK;
    lobe_host_log(host, LOBE_LOG_ERROR, "%s: material '%s' has %u lobes; there may be 1 to %d",
                  scene->name, material->name, material->lobe_count, LOBE_MATERIAL_MAXIMUM_LOBES);
    return LOBE_ERROR_MALFORMED;
}

/// What is wrong with the environment; NULL if nothing.
static const char *fault_of_environment(const lobe_environment *environment) {
    const lobe_image *image = &environment->image;
    if (!image->texels || image->format != LOBE_FORMAT_RGBA32_FLOAT)
        return "is not an image of four 32-bit floats";
    if (!(environment->intensity >= 0) || !isfinite(environment->intensity))
        return "has an intensity that is negative or not finite";
    for (int i = 0; i < 3; i++) {
        const float *a = environment->world_from_environment[i];
        const float *b = environment->world_from_environment[(i + 1) % 3];
        float square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
        float product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        if (!(fabsf(square - 1) < 1e-3f) || !(fabsf(product) < 1e-3f))
            return "has a matrix that is not a rotation";
    }
    const float *texels = image->texels;
    for (size_t i = 0; i < (size_t)image->width * image->height * 4; i++) {
        if (i % 4 != 3 && (!(texels[i] >= 0) || !isfinite(texels[i])))
            return "has a texel that is negative or not finite";
    }
    return NULL;
}

lobe_result passes_scene_check_environment(const lobe_scene *scene, const lobe_host *host) {
    const char *fault = scene->environment ? fault_of_environment(scene->environment) : NULL;
    if (!fault)
        return LOBE_OK;
    lobe_host_log(host, LOBE_LOG_ERROR, "%s: environment '%s' %s", scene->name,
                  scene->environment->name, fault);
    return LOBE_ERROR_MALFORMED;
}
