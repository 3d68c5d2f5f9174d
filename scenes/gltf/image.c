#include <stdio.h>
#include <string.h>

#include "scenes/format/host_file.h"
#include "scenes/format/image_file.h"
#include "scenes/gltf/gltf.h"
#include "scenes/scene/scene.h"

static int hexadecimal(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
        return c - 'A' + 10;
    return -1;
}

// RFC 3986, section 2.1. `out` has room for all of `uri`.
static void decode_percent(const char *uri, char *out) {
    while (*uri) {
        int high = *uri == '%' ? hexadecimal(uri[1]) : -1;
        int low = high >= 0 ? hexadecimal(uri[2]) : -1;
        *out++ = low >= 0 ? (char)(16 * high + low) : *uri;
        uri += low >= 0 ? 3 : 1;
    }
    *out = 0;
}

// The path of a file named relative to the glTF file; to be released.
static char *resolve(const lobe_allocator *allocator, const char *base, const char *uri) {
    const char *slash = strrchr(base, '/');
    size_t folder = slash ? (size_t)(slash - base) + 1 : 0;
    char *path = lobe_allocate(allocator, folder + strlen(uri) + 1, 1);
    if (!path)
        return NULL;
    memcpy(path, base, folder);
    decode_percent(uri, path + folder);
    return path;
}

// Source of encoded bytes: memory of the document, or a file's content, to be released.
typedef struct image_source {
    char name[96];
    const void *bytes;
    size_t size;
    uint8_t *owned;
} image_source;

static lobe_result read_external(const gltf_import *import, const char *uri, image_source *source) {
    if (strstr(uri, "://") || strncmp(uri, "data:", 5) == 0)
        return lobe_host_fail(import->host, LOBE_ERROR_UNSUPPORTED,
                              "%s: image '%.64s': neither a relative path nor a PNG or JPEG "
                              "as a base64 data URI",
                              import->path, uri);
    char *path = resolve(lobe_host_allocator(import->host), import->path, uri);
    if (!path)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              import->path);
    lobe_result result = scenes_host_file_read(import->files, path, import->path, import->host,
                                               &source->owned, &source->size);
    source->bytes = source->owned;
    lobe_release(path);
    return result;
}

static lobe_result find_bytes(const gltf_import *import, int image, image_source *source) {
    const gltf_image *i = &import->document->images[image];
    *source = (image_source){.bytes = i->data, .size = i->size};
    const char *label = *i->uri ? i->uri : i->name;
    if (*label)
        snprintf(source->name, sizeof source->name, "%s", label);
    else
        snprintf(source->name, sizeof source->name, "image %d", image);
    if (i->view >= 0) {
        const uint8_t *bytes;
        size_t stride;
        lobe_result result =
            scenes_gltf_open_view(import, i->view, source->name, &bytes, &source->size, &stride);
        source->bytes = result == LOBE_OK ? bytes : NULL;
        return result;
    }
    return i->size > 0 ? LOBE_OK : read_external(import, i->uri, source);
}

static lobe_result decode(gltf_import *import, const image_source *source, scene_image_use use,
                          lobe_image *image) {
    char name[512];
    snprintf(name, sizeof name, "%s: %s", import->path, source->name);
    lobe_result result =
        scenes_image_decode(source->bytes, source->size, name, use, import->host, image);
    if (result != LOBE_OK)
        return result;
    import->texels += (size_t)image->width * image->height;
    if (import->texels <= GLTF_MAXIMUM_TEXELS)
        return LOBE_OK;
    lobe_image_free(image);
    return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                          "%s: more than %zu texels in the images of the scene", name,
                          GLTF_MAXIMUM_TEXELS);
}

static lobe_result check_index(const gltf_import *import, int image) {
    if (image >= 0 && (size_t)image < import->document->image_count)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: there is no image %d",
                          import->path, image);
}

lobe_result scenes_gltf_decode_image(gltf_import *import, int image, lobe_image *decoded) {
    image_source source = {0};
    *decoded = (lobe_image){0};
    lobe_result result = check_index(import, image);
    if (result == LOBE_OK)
        result = find_bytes(import, image, &source);
    if (result == LOBE_OK)
        result = decode(import, &source, SCENE_IMAGE_COLOUR, decoded);
    lobe_release(source.owned);
    return result;
}

lobe_result scenes_gltf_convert_image(gltf_import *import, int image, bool colour,
                                      int32_t *converted) {
    lobe_result result = check_index(import, image);
    if (result != LOBE_OK)
        return result;
    scene_image_use use = colour ? SCENE_IMAGE_COLOUR : SCENE_IMAGE_DATA;
    int64_t *known = &import->images[use][image];
    if (*known == GLTF_NOT_CONVERTED) {
        image_source source;
        lobe_image decoded = {0};
        uint32_t index = 0;
        result = find_bytes(import, image, &source);
        if (result == LOBE_OK)
            result = decode(import, &source, use, &decoded);
        if (result == LOBE_OK)
            result = scenes_add_image(import->scene, source.name, &decoded, import->host, &index);
        lobe_release(source.owned);
        if (result != LOBE_OK)
            return result;
        *known = index;
    }
    *converted = (int32_t)*known;
    return LOBE_OK;
}
