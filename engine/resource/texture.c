#include "engine/resource/resource.h"

#include <string.h>

#include "engine/device/device.h"
#include "engine/device/vulkan_check.h"
#include "engine/resource/content.h"
#include "engine/resource/shared.h"
#include "engine/resource/upload.h"

static lobe_result check_content(const lobe_host *host, const char *name, const lobe_image *image) {
    if (!image || !image->texels || lobe_format_size(image->format) == 0)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "texture '%s': no image given",
                              name);
    if (image->format == LOBE_FORMAT_D32_FLOAT)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "texture '%s': depth cannot be uploaded", name);
    if (image->width == 0 || image->height == 0)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "texture '%s': an extent of %ux%u",
                              name, image->width, image->height);
    return LOBE_OK;
}

/// Before the texels are read, of which there may be fewer then.
static lobe_result check_extent(const lobe_device *device, const char *name,
                                const lobe_image *image) {
    const uint32_t most = device->limits.maxImageDimension2D;
    if (image->width <= most && image->height <= most)
        return LOBE_OK;
    return lobe_host_fail(&device->host, LOBE_ERROR_LIMIT,
                          "texture '%s': %ux%u is larger than the %ux%u the device allows", name,
                          image->width, image->height, most, most);
}

static lobe_result create_image(lobe_texture *texture) {
    lobe_device *device = texture->device;
    const engine_image_parameters parameters = {
        .name = texture->name,
        .format = texture->format,
        .width = texture->width,
        .height = texture->height,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                 VK_IMAGE_USAGE_TRANSFER_DST_BIT,
    };
    engine_memory_request request = {.name = texture->name, .place = ENGINE_MEMORY_DEVICE};
    lobe_result result =
        engine_image_create(device, &parameters, &texture->image, &request.requirements);
    if (result == LOBE_OK)
        result = engine_upload_target_allocate(device, texture->uploads.queue, &request,
                                               &texture->allocation);
    if (result == LOBE_OK)
        result = VULKAN_CHECK(&device->host,
                              device->api.vkBindImageMemory(device->vulkan, texture->image,
                                                            texture->allocation.memory,
                                                            texture->allocation.offset),
                              "texture '%s'", texture->name);
    return result;
}

static lobe_result create_view(lobe_texture *texture, VkImageViewType type, VkImageView *view) {
    const engine_view_parameters parameters = {
        .name = texture->name,
        .image = texture->image,
        .format = texture->format,
        .type = type,
        .level_count = 1,
        .layer_count = 1,
    };
    return engine_view_create(texture->device, &parameters, view);
}

/// Creates the views that shaders need in advance: graphs of several threads may use the texture.
static lobe_result create_views(lobe_texture *texture) {
    lobe_result result = create_view(texture, VK_IMAGE_VIEW_TYPE_2D, &texture->view);
    if (result == LOBE_OK)
        result = create_view(texture, VK_IMAGE_VIEW_TYPE_2D_ARRAY, &texture->array_view);
    return result;
}

static void free_texture(lobe_texture **texture) {
    if (*texture)
        lobe_release((*texture)->name);
    lobe_release(*texture);
    *texture = NULL;
}

static size_t size_of(const lobe_image *image) {
    return (size_t)image->width * image->height * lobe_format_size(image->format);
}

static bool allocate(lobe_device *device, engine_uploads *queue, const char *name,
                     const lobe_image *image, lobe_texture **texture) {
    *texture = lobe_allocate(device->host.allocator, 1, sizeof **texture);
    if (*texture && ((*texture)->name = lobe_copy_text(device->host.allocator, name)) &&
        engine_upload_target_create(device, queue, size_of(image), &(*texture)->uploads))
        return true;
    free_texture(texture);
    return false;
}

static engine_stamp stamp_of(const lobe_image *image) {
    const uint32_t shape[] = {image->format, image->width, image->height};
    const engine_stamp stamp = engine_stamp_text(ENGINE_STAMP_NONE, "texture");
    return engine_stamp_bytes(engine_stamp_bytes(stamp, shape, sizeof shape), image->texels,
                              size_of(image));
}

static engine_object object_of(const lobe_texture *texture) {
    return (engine_object){.image = texture->image,
                           .views = {texture->view, texture->array_view},
                           .allocation = texture->allocation};
}

/// Takes the image of another graph that has the same content.
static bool adopt(lobe_texture *texture) {
    engine_object object;
    if (!engine_upload_target_adopt(texture->device, &texture->uploads, texture->stamp, &object))
        return false;
    texture->image = object.image;
    texture->view = object.views[0];
    texture->array_view = object.views[1];
    texture->allocation = object.allocation;
    texture->filled = true;
    return true;
}

static lobe_result make(lobe_texture *texture, const lobe_image *image) {
    const lobe_rectangle whole = {0, 0, texture->width, texture->height};
    lobe_result result = create_image(texture);
    if (result == LOBE_OK)
        result = create_views(texture);
    if (result == LOBE_OK)
        result = engine_texture_write(texture, image, &whole, true);
    const engine_object object = object_of(texture);
    if (result == LOBE_OK)
        engine_upload_target_offer(texture->device, &texture->uploads, texture->stamp, &object);
    return result;
}

lobe_result engine_texture_create_for(lobe_device *device, engine_uploads *queue,
                                      const lobe_texture_parameters *parameters,
                                      lobe_texture **texture) {
    const char *name = parameters->name ? parameters->name : "texture";
    lobe_result result = check_content(&device->host, name, parameters->image);
    if (result == LOBE_OK)
        result = check_extent(device, name, parameters->image);
    if (result != LOBE_OK)
        return result;
    if (!allocate(device, queue, name, parameters->image, texture))
        return lobe_host_fail(&device->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "texture '%s': out of memory", name);
    (*texture)->device = device;
    (*texture)->format = parameters->image->format;
    (*texture)->width = parameters->image->width;
    (*texture)->height = parameters->image->height;
    (*texture)->stamp = stamp_of(parameters->image);
    result = adopt(*texture) ? LOBE_OK : make(*texture, parameters->image);
    if (result != LOBE_OK)
        lobe_texture_destroy(texture);
    return result;
}

lobe_result lobe_texture_create(lobe_device *device, const lobe_texture_parameters *parameters,
                                lobe_texture **texture) {
    if (texture)
        *texture = NULL;
    if (!device || !parameters || !texture)
        return lobe_host_fail(
            device ? &device->host : NULL, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_texture_create: device, parameters and texture must not be NULL");
    return engine_texture_create_for(device, NULL, parameters, texture);
}

bool lobe_texture_takes(const lobe_texture *texture, const lobe_image *image) {
    if (!texture || !image)
        return false;
    return image->format == texture->format && image->width == texture->width &&
           image->height == texture->height;
}

lobe_result lobe_texture_update(lobe_texture *texture, const lobe_image *image) {
    return lobe_texture_update_part(texture, image, NULL);
}

static lobe_result check_part(const lobe_texture *texture, const lobe_rectangle *part) {
    if (lobe_rectangle_lies_within(part, texture->width, texture->height))
        return LOBE_OK;
    return lobe_host_fail(&texture->device->host, LOBE_ERROR_INVALID_ARGUMENT,
                          "texture '%s' is %ux%u, without %ux%u texels at (%u, %u)", texture->name,
                          texture->width, texture->height, part->width, part->height, part->x,
                          part->y);
}

/// Others keep the present image.
static lobe_result replace(lobe_texture *texture, const lobe_image *image) {
    const lobe_texture former = *texture;
    lobe_texture *made;
    const lobe_result result = engine_texture_create_for(
        texture->device, texture->uploads.queue,
        &(lobe_texture_parameters){.name = texture->name, .image = image}, &made);
    if (result != LOBE_OK)
        return result;
    engine_uploads_redirect(texture->uploads.queue, made, texture);
    *texture = *made;
    *made = former;
    lobe_texture_destroy(&made);
    return LOBE_OK;
}

lobe_result lobe_texture_update_part(lobe_texture *texture, const lobe_image *image,
                                     const lobe_rectangle *part) {
    if (!texture)
        return LOBE_ERROR_INVALID_ARGUMENT;
    const lobe_rectangle whole = {0, 0, texture->width, texture->height};
    const lobe_host *host = &texture->device->host;
    if (!part)
        part = &whole;
    lobe_result result = check_content(host, texture->name, image);
    if (result != LOBE_OK)
        return result;
    if (!lobe_texture_takes(texture, image))
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "texture '%s' is %ux%u %s, the new content %ux%u %s", texture->name,
                              texture->width, texture->height, lobe_format_name(texture->format),
                              image->width, image->height, lobe_format_name(image->format));
    result = check_part(texture, part);
    if (result != LOBE_OK)
        return result;
    return engine_shared_claim(texture->device, texture->uploads.shared)
               ? engine_texture_write(texture, image, part, false)
               : replace(texture, image);
}

void lobe_texture_destroy(lobe_texture **texture) {
    if (!texture || !*texture)
        return;
    engine_object object = object_of(*texture);
    engine_upload_target_destroy((*texture)->device, &(*texture)->uploads, &object);
    free_texture(texture);
}
