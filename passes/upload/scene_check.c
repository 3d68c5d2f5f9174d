#include "passes/upload/scene_check.h"

#include <math.h>
#include <stdio.h>

#include "passes/upload/deformation/deformation_check.h"
#include "passes/upload/material_maps.h"
#include "passes/upload/number_check.h"

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

/// The first channel of a row, from `first` to before `end`, that is not finite; `end`: none.
static size_t find_not_finite(const lobe_image *image, uint32_t exponent, size_t first,
                              size_t end) {
    const uint16_t *halves = image->texels;
    const uint32_t *singles = image->texels;
    for (size_t i = first; i < end; i++) {
        uint32_t bits = exponent == 0x7c00 ? halves[i] : singles[i];
        if ((bits & exponent) == exponent)
            return i;
    }
    return end;
}

static lobe_result check_texels(const lobe_scene *scene, size_t index, const lobe_rectangle *part,
                                const lobe_host *host) {
    const lobe_image *image = &scene->images[index].image;
    const uint32_t exponent = exponent_bits(image->format);
    const size_t channels = lobe_format_channels(image->format);
    for (uint32_t y = 0; exponent && y < part->height; y++) {
        const size_t row = (size_t)(part->y + y) * image->width * channels;
        const size_t end = row + ((size_t)part->x + part->width) * channels;
        const size_t found = find_not_finite(image, exponent, row + part->x * channels, end);
        if (found < end)
            return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                                  "%s: image '%s': texel %zu, %u is not finite", scene->name,
                                  scene->images[index].name, (found - row) / channels, part->y + y);
    }
    return LOBE_OK;
}

bool passes_format_has_sign(lobe_format format) {
    switch (format) {
    case LOBE_FORMAT_BC5_SNORM:
    case LOBE_FORMAT_RG8_SNORM:
    case LOBE_FORMAT_RGBA8_SNORM:
    case LOBE_FORMAT_RG16_SNORM:
    case LOBE_FORMAT_RGBA16_SNORM:
        return true;
    default:
        return exponent_bits(format) != 0;
    }
}

bool passes_format_is_srgb(lobe_format format) {
    switch (format) {
    case LOBE_FORMAT_RGBA8_SRGB:
    case LOBE_FORMAT_BGRA8_SRGB:
    case LOBE_FORMAT_BC1_SRGB:
    case LOBE_FORMAT_BC3_SRGB:
    case LOBE_FORMAT_BC7_SRGB:
        return true;
    default:
        return false;
    }
}

uint32_t passes_normal_channels(lobe_normal_encoding encoding) {
    return encoding == LOBE_NORMALS_UNSIGNED || encoding == LOBE_NORMALS_SIGNED ? 3 : 2;
}

bool passes_scene_has_normals_in(const lobe_scene *scene, size_t image) {
    for (size_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].normal_map.image == (int32_t)image)
            return true;
    return false;
}

lobe_result passes_scene_check_normals(const lobe_scene *scene, size_t index,
                                       const lobe_host *host) {
    const lobe_scene_image *image = &scene->images[index];
    if (image->on_device)
        return LOBE_OK;
    const uint32_t needed = passes_normal_channels(image->normals),
                   channels = lobe_format_channels(image->image.format);
    if (passes_format_is_srgb(image->image.format))
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: image '%s': normals in the format %s, which is for colours",
                              scene->name, image->name, lobe_format_name(image->image.format));
    if (channels >= needed || channels == 0) // of 0, the image itself is refused
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                          "%s: image '%s': normals of %u channels in the format %s, which has %u",
                          scene->name, image->name, needed, lobe_format_name(image->image.format),
                          channels);
}

/// What the host gives on the device has a format of its own, which is checked when it is given.
static lobe_result check_encoding(const lobe_scene *scene, size_t index, const lobe_host *host) {
    const lobe_scene_image *image = &scene->images[index];
    if ((unsigned)image->normals > LOBE_NORMALS_SIGNED_XY)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: image '%s': there is no encoding of normals %d", scene->name,
                              image->name, (int)image->normals);
    if (passes_normals_are_signed(image->normals) && !image->on_device &&
        !passes_format_has_sign(image->image.format))
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: image '%s': signed normals in the format %s, which has no sign",
                              scene->name, image->name, lobe_format_name(image->image.format));
    return passes_scene_has_normals_in(scene, index)
               ? passes_scene_check_normals(scene, index, host)
               : LOBE_OK;
}

lobe_result passes_scene_check_image(const lobe_scene *scene, size_t index,
                                     const lobe_rectangle *part, const lobe_host *host) {
    const lobe_image *image = &scene->images[index].image;
    const lobe_rectangle whole = {0, 0, image->width, image->height};
    const bool has_texels = image->texels || scene->images[index].on_device;
    if (!has_texels || image->width == 0 || image->height == 0 ||
        lobe_format_size(image->format) == 0 || image->format == LOBE_FORMAT_D32_FLOAT)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: image '%s' has %ux%u texels of %s%s",
                              scene->name, scene->images[index].name, image->width, image->height,
                              lobe_format_name(image->format),
                              has_texels ? "" : ", but no memory with them");
    const lobe_result result = check_encoding(scene, index, host);
    return result || !image->texels ? result
                                    : check_texels(scene, index, part ? part : &whole, host);
}

static bool all_finite(const lobe_scene_vertex *vertex) {
    const float *values = (const float *)vertex;
    for (size_t i = 0; i < sizeof *vertex / sizeof *values; i++) {
        if (!isfinite(values[i]))
            return false;
    }
    return true;
}

static bool has_normal(const lobe_scene_vertex *vertex) {
    return vertex->normal[0] != 0 || vertex->normal[1] != 0 || vertex->normal[2] != 0;
}

/// Says which number of a vertex is not finite.
static lobe_result fail_vertex(const number_owner *mesh, const lobe_scene_vertex *vertex,
                               size_t index) {
    const struct {
        const char *name;
        const float *values;
        size_t count;
    } members[] = {
        {"position", vertex->position, 3},
        {"normal", vertex->normal, 3},
        {"tangent", vertex->tangent, 4},
        {"texture_coordinates", vertex->texture_coordinates[0], 4},
        {"colour", vertex->colour, 4},
    };
    lobe_result result = LOBE_OK;
    for (size_t i = 0; !result && i < sizeof members / sizeof *members; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s of vertex %zu", members[i].name, index);
        result = passes_check_numbers(mesh, name, members[i].values, members[i].count, -INFINITY,
                                      INFINITY);
    }
    return result;
}

static lobe_result check_vertices(const number_owner *owner, const lobe_mesh *mesh) {
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (!all_finite(&mesh->vertices[i]))
            return fail_vertex(owner, &mesh->vertices[i], i);
        if (!has_normal(&mesh->vertices[i]))
            return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                                  "%s: mesh '%s': the normal of vertex %zu has no length",
                                  owner->where, mesh->name, i);
    }
    return LOBE_OK;
}

static lobe_result check_triangles(const lobe_scene *scene, const lobe_mesh *mesh,
                                   const lobe_host *host) {
    if (mesh->vertex_count == 0 || mesh->index_count < 3 || !mesh->vertices || !mesh->indices)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: mesh '%s' has no triangles",
                              scene->name, mesh->name);
    if (mesh->index_count % 3 != 0)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: mesh '%s' has %zu indices; expected three for each triangle",
                              scene->name, mesh->name, mesh->index_count);
    for (size_t i = 0; i < mesh->index_count; i++) {
        if (mesh->indices[i] >= mesh->vertex_count)
            return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                                  "%s: mesh '%s': index %zu is vertex %u of %zu", scene->name,
                                  mesh->name, i, mesh->indices[i], mesh->vertex_count);
    }
    return LOBE_OK;
}

/// The bounds decide which maps a pixel may see at level 0.
static lobe_result check_bounds(const number_owner *owner, const lobe_mesh *mesh) {
    lobe_result result =
        passes_check_numbers(owner, "minimum", mesh->minimum, 3, -INFINITY, INFINITY);
    return result ? result
                  : passes_check_numbers(owner, "maximum", mesh->maximum, 3, -INFINITY, INFINITY);
}

lobe_result passes_scene_check_mesh(const lobe_scene *scene, size_t index, const lobe_host *host) {
    const lobe_mesh *mesh = &scene->meshes[index];
    const number_owner owner = {
        .host = host, .where = scene->name, .kind = "mesh", .name = mesh->name, .index = index};
    lobe_result result = check_triangles(scene, mesh, host);
    result = result ? result : check_bounds(&owner, mesh);
    result = result ? result : check_vertices(&owner, mesh);
    return result ? result : passes_check_deformation(&owner, mesh);
}

/// Instances are numbered from 1 on, in 32 bits.
lobe_result passes_scene_check_instance_array(const lobe_scene *scene, const lobe_host *host) {
    if (scene->instance_count >= UINT32_MAX)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT, "%s: %zu instances", scene->name,
                              scene->instance_count);
    if (scene->instance_count == 0 || scene->instances)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: %zu instances, but no array of them",
                          scene->name, scene->instance_count);
}

lobe_result passes_scene_check_arrays(const lobe_scene *scene, const lobe_host *host) {
    const struct {
        const char *name;
        const void *array;
        size_t count;
    } arrays[] = {
        {"images", scene->images, scene->image_count},
        {"materials", scene->materials, scene->material_count},
        {"meshes", scene->meshes, scene->mesh_count},
    };
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        if (arrays[i].count > 0 && !arrays[i].array)
            return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: %zu %s, but no array of them",
                                  scene->name, arrays[i].count, arrays[i].name);
    }
    if (scene->instance_count > 0)
        return passes_scene_check_instance_array(scene, host);
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: there is nothing to draw", scene->name);
}

lobe_result passes_scene_check_environment(const lobe_scene *scene, const lobe_host *host) {
    if (!scene->environment)
        return LOBE_OK;
    const char *name = scene->environment->name;
    const lobe_image *image = &scene->environment->image;
    const float *texels = image->texels;
    if (!texels || image->width == 0 || image->height == 0 ||
        image->format != LOBE_FORMAT_RGBA32_FLOAT)
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: environment '%s' is not an image of four 32-bit floats",
                              scene->name, name);
    double position[2];
    if (!lobe_environment_position(scene->environment, (const double[]){0, 0, 1}, position))
        return lobe_host_fail(
            host, LOBE_ERROR_MALFORMED,
            "%s: environment '%s': %ux%u texels do not have the shape of layout %d", scene->name,
            name, image->width, image->height, (int)scene->environment->layout);
    for (size_t i = 0; i < (size_t)image->width * image->height * 4; i++) {
        if (i % 4 == 3 || (texels[i] >= 0 && isfinite(texels[i])))
            continue;
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: environment '%s': texel %zu, %zu has the value %g, which is "
                              "negative or not finite",
                              scene->name, name, i / 4 % image->width, i / 4 / image->width,
                              (double)texels[i]);
    }
    return LOBE_OK;
}
