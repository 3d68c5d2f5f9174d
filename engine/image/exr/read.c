#include <lobe/exr.h>

#include <stdbool.h>
#include <string.h>

#include "engine/image/exr/decode.h"

/// Largest number of bytes that a block may decompress to; real files stay far below.
#define BLOCK_MAXIMUM_SIZE ((uint64_t)1 << 30)

// ---------------------------------------------------------------------------------------------
// Which channels

/// A channel's name within the layer; NULL if it belongs to another layer.
static const char *name_in_layer(const char *channel, const char *layer) {
    if (layer != NULL) {
        size_t length = strlen(layer);
        if (strncmp(channel, layer, length) != 0 || channel[length] != '.')
            return NULL;
        channel += length + 1;
    }
    return strchr(channel, '.') == NULL ? channel : NULL;
}

static int find_channel(const exr_attr_chlist_t *channels, const char *layer, const char *name) {
    for (int index = 0; index < channels->num_channels; index++) {
        const char *candidate = name_in_layer(channels->entries[index].name.str, layer);
        if (candidate != NULL && strcmp(candidate, name) == 0)
            return index;
    }
    return -1;
}

/// The layer's only channel apart from alpha; -1 if there are none or several.
static int find_only_channel(const exr_attr_chlist_t *channels, const char *layer) {
    int found = -1;
    for (int index = 0; index < channels->num_channels; index++) {
        const char *name = name_in_layer(channels->entries[index].name.str, layer);
        if (name == NULL || strcmp(name, "A") == 0)
            continue;
        if (found >= 0)
            return -1;
        found = index;
    }
    return found;
}

static bool find_three(const exr_attr_chlist_t *channels, const char *layer,
                       const char *const names[3], int sources[4]) {
    for (int component = 0; component < 3; component++)
        sources[component] = find_channel(channels, layer, names[component]);
    return sources[0] >= 0 && sources[1] >= 0 && sources[2] >= 0;
}

static bool find_sources(const exr_attr_chlist_t *channels, const char *layer, int sources[4]) {
    static const char *const colour[3] = {"R", "G", "B"}, *const vector[3] = {"X", "Y", "Z"};
    sources[3] = find_channel(channels, layer, "A");
    if (find_three(channels, layer, colour, sources) ||
        find_three(channels, layer, vector, sources))
        return true;
    int grey = find_channel(channels, layer, "Y");
    if (grey < 0)
        grey = find_only_channel(channels, layer);
    sources[0] = sources[1] = sources[2] = grey;
    return grey >= 0;
}

static bool is_flat(const exr_reader *reader, int part) {
    exr_storage_t storage;
    return exr_get_storage(reader->input.context, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

/// Looks for the layer as a prefix of channel names; with `as_part` as the name of a part.
static bool find_part(exr_reader *reader, const char *layer, bool as_part) {
    int count = 0;
    exr_get_count(reader->input.context, &count);
    for (int part = 0; part < count; part++) {
        const char *name = NULL;
        if (as_part && (exr_get_name(reader->input.context, part, &name) != EXR_ERR_SUCCESS ||
                        name == NULL || strcmp(name, layer) != 0))
            continue;
        if (is_flat(reader, part) &&
            exr_get_channels(reader->input.context, part, &reader->channels) == EXR_ERR_SUCCESS &&
            find_sources(reader->channels, as_part ? NULL : layer, reader->sources)) {
            reader->part = part;
            return true;
        }
    }
    return false;
}

static bool has_flat_part(const exr_reader *reader) {
    int count = 0;
    exr_get_count(reader->input.context, &count);
    for (int part = 0; part < count; part++) {
        if (is_flat(reader, part))
            return true;
    }
    return false;
}

static lobe_result choose_channels(exr_reader *reader, const char *layer) {
    if (!has_flat_part(reader))
        return lobe_host_fail(reader->input.host, LOBE_ERROR_UNSUPPORTED,
                              "%s: deep OpenEXR data is not supported", reader->input.path);
    if (!find_part(reader, layer, false) && (layer == NULL || !find_part(reader, layer, true))) {
        if (layer != NULL)
            return lobe_host_fail(reader->input.host, LOBE_ERROR_NOT_FOUND,
                                  "%s: there is no layer '%s'", reader->input.path, layer);
        return lobe_host_fail(reader->input.host, LOBE_ERROR_UNSUPPORTED,
                              "%s: there are neither channels R, G, B nor Y", reader->input.path);
    }
    for (int index = 0; index < reader->channels->num_channels; index++) {
        if (reader->channels->entries[index].x_sampling < 1 ||
            reader->channels->entries[index].y_sampling < 1)
            return engine_exr_fail_damaged(&reader->input, "a channel has a sampling rate below 1");
    }
    for (int component = 0; component < 4; component++) {
        int source = reader->sources[component];
        if (source >= 0 && (reader->channels->entries[source].x_sampling != 1 ||
                            reader->channels->entries[source].y_sampling != 1))
            return lobe_host_fail(reader->input.host, LOBE_ERROR_UNSUPPORTED,
                                  "%s: subsampled channels are not supported", reader->input.path);
    }
    if (find_channel(reader->channels, NULL, "RY") >= 0)
        lobe_host_log(reader->input.host, LOBE_LOG_WARNING,
                      "%s: the colour differences RY and BY are ignored, the image becomes grey",
                      reader->input.path);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Sizes, before anything is allocated

static lobe_result check_window(const exr_reader *reader, const exr_attr_box2i_t *window,
                                const char *name) {
    exr_block block = engine_exr_block_of_window(window);
    if (block.width < 1 || block.height < 1)
        return lobe_host_fail(reader->input.host, LOBE_ERROR_MALFORMED,
                              "%s: damaged OpenEXR file: the %s window is empty",
                              reader->input.path, name);
    if (block.width > LOBE_IMAGE_MAXIMUM_EXTENT || block.height > LOBE_IMAGE_MAXIMUM_EXTENT ||
        (uint64_t)block.width * (uint64_t)block.height > LOBE_EXR_MAXIMUM_TEXELS)
        return lobe_host_fail(reader->input.host, LOBE_ERROR_LIMIT,
                              "%s: the %s window of %lldx%lld texels is too large",
                              reader->input.path, name, (long long)block.width,
                              (long long)block.height);
    return LOBE_OK;
}

static lobe_result check_sizes(exr_reader *reader) {
    uint64_t block_size = 0;
    reader->input.message[0] = '\0'; // drop the message about a part without a name
    exr_result_t code =
        exr_get_data_window(reader->input.context, reader->part, &reader->data_window);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_display_window(reader->input.context, reader->part, &reader->display_window);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_chunk_unpacked_size(reader->input.context, reader->part, &block_size);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    lobe_result result = check_window(reader, &reader->data_window, "data");
    if (result == LOBE_OK)
        result = check_window(reader, &reader->display_window, "display");
    if (result == LOBE_OK && block_size > BLOCK_MAXIMUM_SIZE)
        return lobe_host_fail(reader->input.host, LOBE_ERROR_LIMIT,
                              "%s: blocks of %llu bytes are too large", reader->input.path,
                              (unsigned long long)block_size);
    return result;
}

/// Coarser levels are read only if the display window neither cuts nor pads the finest one.
static lobe_result count_levels(exr_reader *reader) {
    exr_storage_t storage;
    exr_tile_level_mode_t mode;
    exr_tile_round_mode_t rounding;
    uint32_t width, height;
    int32_t columns, rows;
    reader->level_count = 1;
    if (memcmp(&reader->data_window, &reader->display_window, sizeof reader->data_window) != 0 ||
        exr_get_storage(reader->input.context, reader->part, &storage) != EXR_ERR_SUCCESS ||
        storage != EXR_STORAGE_TILED || engine_exr_is_left_to_openexr(reader))
        return LOBE_OK;
    exr_result_t code = exr_get_tile_descriptor(reader->input.context, reader->part, &width,
                                                &height, &mode, &rounding);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_tile_levels(reader->input.context, reader->part, &columns, &rows);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    if (mode == EXR_TILE_MIPMAP_LEVELS)
        reader->level_count = (uint32_t)columns;
    return LOBE_OK;
}

static lobe_result open_layer(exr_reader *reader, const exr_origin *origin, const char *layer,
                              const lobe_host *host) {
    lobe_result result = engine_exr_open(origin, host, &reader->input);
    if (result == LOBE_OK)
        result = choose_channels(reader, layer);
    if (result == LOBE_OK)
        result = check_sizes(reader);
    if (result == LOBE_OK)
        result = count_levels(reader);
    return result;
}

static void close_layer(exr_reader *reader) {
    if (reader->pipeline_started)
        exr_decoding_destroy(reader->input.context, &reader->pipeline);
    engine_exr_close(&reader->input);
}

lobe_result lobe_exr_read(const char *path, const char *layer, const lobe_host *host,
                          lobe_image *image) {
    if (image)
        *image = (lobe_image){0};
    if (!path || !image)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_exr_read: path and image must not be NULL");
    exr_reader reader = {0};
    lobe_result result = open_layer(&reader, &(exr_origin){.path = path}, layer, host);
    if (result == LOBE_OK)
        result = engine_exr_decode_level(&reader, 0, image);
    if (result != LOBE_OK)
        lobe_image_free(image);
    close_layer(&reader);
    return result;
}

// ---------------------------------------------------------------------------------------------
// The contents of a file

static lobe_result fail_without_memory(const exr_reader *reader) {
    return lobe_host_fail(reader->input.host, LOBE_ERROR_OUT_OF_MEMORY,
                          "%s: out of memory decoding it", reader->input.path);
}

static lobe_result read_levels(exr_reader *reader, lobe_exr_contents *contents) {
    contents->levels = lobe_allocate(lobe_host_allocator(reader->input.host), reader->level_count,
                                     sizeof *contents->levels);
    if (contents->levels == NULL)
        return fail_without_memory(reader);
    lobe_result result = LOBE_OK;
    for (uint32_t level = 0; level < reader->level_count && result == LOBE_OK; level++) {
        contents->level_count = level + 1;
        result = engine_exr_decode_level(reader, level, &contents->levels[level]);
    }
    return result;
}

/// Copies up to the first zero byte, or the end.
static char *copy_string(const lobe_allocator *allocator, const exr_attr_string_t *string) {
    const size_t length = strnlen(string->str, (size_t)string->length);
    char *copy = lobe_allocate(allocator, length + 1, 1);
    return copy ? memcpy(copy, string->str, length) : NULL;
}

/// False if the attribute has another type. A text is NULL if out of memory.
static bool copy_attribute(const lobe_allocator *allocator, const exr_attribute_t *source,
                           lobe_exr_attribute *target) {
    *target = (lobe_exr_attribute){0};
    switch (source->type) {
    case EXR_ATTR_STRING:
        target->type = LOBE_EXR_TEXT;
        target->text = copy_string(allocator, source->string);
        break;
    case EXR_ATTR_FLOAT:
        target->type = LOBE_EXR_NUMBER;
        target->number = source->f;
        break;
    case EXR_ATTR_INT:
        target->type = LOBE_EXR_INTEGER;
        target->integer = source->i;
        break;
    default:
        return false;
    }
    target->name = lobe_copy_text(allocator, source->name);
    return true;
}

static lobe_result read_attributes(exr_reader *reader, lobe_exr_contents *contents) {
    const lobe_allocator *allocator = lobe_host_allocator(reader->input.host);
    int32_t count = 0;
    exr_result_t code = exr_get_attribute_count(reader->input.context, reader->part, &count);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    contents->attributes =
        lobe_allocate(allocator, (size_t)count + 1, sizeof *contents->attributes);
    if (contents->attributes == NULL)
        return fail_without_memory(reader);
    for (int32_t index = 0; index < count; index++) {
        const exr_attribute_t *source;
        code = exr_get_attribute_by_index(reader->input.context, reader->part,
                                          EXR_ATTR_LIST_FILE_ORDER, index, &source);
        if (code != EXR_ERR_SUCCESS)
            return engine_exr_fail(&reader->input, code);
        lobe_exr_attribute *target = &contents->attributes[contents->attribute_count];
        if (!copy_attribute(allocator, source, target))
            continue;
        contents->attribute_count++;
        if (target->name == NULL || (target->type == LOBE_EXR_TEXT && target->text == NULL))
            return fail_without_memory(reader);
    }
    return LOBE_OK;
}

static lobe_exr_environment find_environment(const exr_reader *reader) {
    exr_envmap_t kind;
    if (exr_attr_get_envmap(reader->input.context, reader->part, "envmap", &kind) !=
        EXR_ERR_SUCCESS)
        return LOBE_EXR_NO_ENVIRONMENT;
    return kind == EXR_ENVMAP_CUBE ? LOBE_EXR_CUBE : LOBE_EXR_LATITUDE_LONGITUDE;
}

static void read_chromaticities(const exr_reader *reader, float chromaticities[4][2]) {
    exr_attr_chromaticities_t found = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    exr_attr_get_chromaticities(reader->input.context, reader->part, "chromaticities", &found);
    memcpy(chromaticities, &found, sizeof found);
}

static lobe_result read_contents(const exr_origin *origin, const char *layer, const lobe_host *host,
                                 lobe_exr_contents *contents) {
    *contents = (lobe_exr_contents){0};
    exr_reader reader = {0};
    lobe_result result = open_layer(&reader, origin, layer, host);
    if (result == LOBE_OK)
        result = read_attributes(&reader, contents);
    if (result == LOBE_OK)
        result = read_levels(&reader, contents);
    if (result == LOBE_OK) {
        contents->environment = find_environment(&reader);
        read_chromaticities(&reader, contents->chromaticities);
    } else {
        lobe_exr_contents_free(contents);
    }
    close_layer(&reader);
    return result;
}

lobe_result lobe_exr_read_contents(const char *path, const char *layer, const lobe_host *host,
                                   lobe_exr_contents *contents) {
    if (contents)
        *contents = (lobe_exr_contents){0};
    if (!path || !contents)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_exr_read_contents: path and contents must not be NULL");
    return read_contents(&(exr_origin){.path = path}, layer, host, contents);
}

lobe_result lobe_exr_decode_contents(const char *name, const void *data, size_t size,
                                     const char *layer, const lobe_host *host,
                                     lobe_exr_contents *contents) {
    if (contents)
        *contents = (lobe_exr_contents){0};
    if (!name || !data || !contents)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_exr_decode_contents: name, data and contents must not be NULL");
    return read_contents(&(exr_origin){name, data, size}, layer, host, contents);
}

const lobe_exr_attribute *lobe_exr_find_attribute(const lobe_exr_contents *contents,
                                                  const char *name, lobe_exr_attribute_type type) {
    if (!contents || !name)
        return NULL;
    for (size_t index = 0; index < contents->attribute_count; index++) {
        const lobe_exr_attribute *attribute = &contents->attributes[index];
        if (attribute->type == type && strcmp(attribute->name, name) == 0)
            return attribute;
    }
    return NULL;
}

void lobe_exr_contents_free(lobe_exr_contents *contents) {
    if (contents == NULL)
        return;
    for (uint32_t level = 0; level < contents->level_count; level++)
        lobe_image_free(&contents->levels[level]);
    for (size_t index = 0; index < contents->attribute_count; index++) {
        lobe_release((char *)contents->attributes[index].name);
        lobe_release((char *)contents->attributes[index].text);
    }
    lobe_release(contents->levels);
    lobe_release(contents->attributes);
    *contents = (lobe_exr_contents){0};
}
