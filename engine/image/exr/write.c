#include <lobe/exr.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>

#include "engine/image/exr/encode.h"
#include "engine/image/half.h"

/// A fixed level, so that the bytes do not depend on the process's defaults.
#define ZIP_LEVEL 4

// ---------------------------------------------------------------------------------------------
// Channels

static bool is_float_format(lobe_format format) {
    switch (format) {
    case LOBE_FORMAT_R16_FLOAT:
    case LOBE_FORMAT_RG16_FLOAT:
    case LOBE_FORMAT_RGBA16_FLOAT:
    case LOBE_FORMAT_R32_FLOAT:
    case LOBE_FORMAT_RG32_FLOAT:
    case LOBE_FORMAT_RGBA32_FLOAT:
        return true;
    default:
        return false;
    }
}

static const char *const *channel_names(const lobe_exr_layer *layer) {
    static const char *const one[4] = {"Y"}, *const two[4] = {"X", "Y"},
                             *const four[4] = {"R", "G", "B", "A"};
    for (int component = 0; component < 4; component++) {
        if (layer->channels[component] != NULL)
            return layer->channels;
    }
    uint32_t count = lobe_format_channels(layer->image->format);
    return count == 1 ? one : count == 2 ? two : four;
}

static lobe_result add_channel(exr_writer *writer, const lobe_exr_layer *layer, uint32_t component,
                               const char *name) {
    exr_channel *channel = &writer->channels[writer->channel_count++];
    bool prefixed = layer->name != NULL;
    int length = snprintf(channel->name, sizeof channel->name, "%s%s%s",
                          prefixed ? layer->name : "", prefixed ? "." : "", name);
    if (name[0] == '\0' || length > EXR_NAME_MAXIMUM_LENGTH)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: a channel name must have 1 to %d bytes", writer->path,
                              EXR_NAME_MAXIMUM_LENGTH);
    channel->layer = layer;
    channel->component = component;
    return LOBE_OK;
}

static const char *layer_name(const lobe_exr_layer *layer) {
    return layer->name != NULL ? layer->name : "main";
}

static uint32_t level_extent(uint32_t extent, uint32_t level) {
    return extent >> level > 0 ? extent >> level : 1;
}

static lobe_result check_level(const exr_writer *writer, const lobe_exr_layer *layer,
                               uint32_t level) {
    const lobe_image *image = &layer->image[level];
    if (!is_float_format(image->format))
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: layer '%s' has format %s, which is not a float format",
                              writer->path, layer_name(layer), lobe_format_name(image->format));
    uint32_t width = level_extent(writer->width, level);
    uint32_t height = level_extent(writer->height, level);
    if (!image->texels || image->width == 0 || image->height == 0)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: layer '%s' has no texels on level %u", writer->path,
                              layer_name(layer), level);
    if (image->width != width || image->height != height)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: layer '%s' has %ux%u texels on level %u instead of %ux%u",
                              writer->path, layer_name(layer), image->width, image->height, level,
                              width, height);
    if (lobe_format_channels(image->format) != lobe_format_channels(layer->image->format))
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: levels of layer '%s' differ in their channels", writer->path,
                              layer_name(layer));
    return LOBE_OK;
}

static lobe_result add_layer(exr_writer *writer, const lobe_exr_layer *layer) {
    const lobe_image *image = layer->image;
    lobe_result result = LOBE_OK;
    for (uint32_t level = 0; level < writer->level_count && result == LOBE_OK; level++)
        result = check_level(writer, layer, level);
    const char *const *names = channel_names(layer);
    for (uint32_t component = 0; component < 4 && result == LOBE_OK; component++) {
        if (names[component] == NULL)
            continue;
        if (component >= lobe_format_channels(image->format))
            return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                                  "%s: layer '%s' names more channels than %s has", writer->path,
                                  layer_name(layer), lobe_format_name(image->format));
        result = add_channel(writer, layer, component, names[component]);
    }
    return result;
}

static int compare_channels(const void *left, const void *right) {
    return strcmp(((const exr_channel *)left)->name, ((const exr_channel *)right)->name);
}

static lobe_result choose_extent(exr_writer *writer, const lobe_exr_parameters *parameters) {
    if (parameters->layer_count == 0 || !parameters->layers)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT, "%s: no layer to write",
                              writer->path);
    if (parameters->attribute_count > 0 && !parameters->attributes)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: %zu attributes, but no array of them", writer->path,
                              parameters->attribute_count);
    for (size_t i = 0; i < parameters->layer_count; i++) {
        if (!parameters->layers[i].image)
            return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                                  "%s: layer '%s' has no image", writer->path,
                                  layer_name(&parameters->layers[i]));
    }
    writer->width = parameters->layers[0].image->width;
    writer->height = parameters->layers[0].image->height;
    writer->level_count = parameters->level_count > 0 ? parameters->level_count : 1;
    return LOBE_OK;
}

static lobe_result collect_channels(exr_writer *writer, const lobe_exr_parameters *parameters) {
    writer->channels = lobe_allocate(lobe_host_allocator(writer->host), 4 * parameters->layer_count,
                                     sizeof *writer->channels);
    if (writer->channels == NULL)
        return lobe_host_fail(writer->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "%s: out of memory encoding it", writer->path);
    for (size_t index = 0; index < parameters->layer_count; index++) {
        lobe_result result = add_layer(writer, &parameters->layers[index]);
        if (result != LOBE_OK)
            return result;
    }
    qsort(writer->channels, writer->channel_count, sizeof *writer->channels, compare_channels);
    for (size_t index = 1; index < writer->channel_count; index++) {
        if (compare_channels(&writer->channels[index - 1], &writer->channels[index]) == 0)
            return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                                  "%s: channel '%s' is given twice", writer->path,
                                  writer->channels[index].name);
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Header

static int64_t write_output(exr_const_context_t context, void *user, const void *buffer,
                            uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report) {
    (void)context;
    (void)report;
    exr_writer *writer = user;
    if (engine_bytes_write(&writer->output, offset, buffer, size))
        return (int64_t)size;
    writer->out_of_memory = true;
    return -1;
}

static void ignore_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

static lobe_result fail_from_library(const exr_writer *writer, exr_result_t code,
                                     const char *what) {
    bool memory = writer->out_of_memory || code == EXR_ERR_OUT_OF_MEMORY;
    return lobe_host_fail(writer->host,
                          memory ? LOBE_ERROR_OUT_OF_MEMORY : LOBE_ERROR_INVALID_ARGUMENT,
                          "%s: cannot encode %s: %s", writer->path, what,
                          memory ? "out of memory" : exr_get_default_error_message(code));
}

/// ITU-R BT.709, item 1.4: the primaries, and the white point D65.
static const exr_attr_chromaticities_t rec709 = {
    .red_x = 0.640f,
    .red_y = 0.330f,
    .green_x = 0.300f,
    .green_y = 0.600f,
    .blue_x = 0.150f,
    .blue_y = 0.060f,
    .white_x = 0.3127f,
    .white_y = 0.3290f,
};

static exr_result_t declare_image(exr_writer *writer, lobe_exr_environment environment) {
    int part;
    bool tiled = writer->level_count > 1;
    exr_result_t code = exr_set_longname_support(writer->context, 1);
    if (code == EXR_ERR_SUCCESS)
        code = exr_add_part(writer->context, NULL, tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE,
                            &part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(writer->context, 0, (int32_t)writer->width,
                                                   (int32_t)writer->height, EXR_COMPRESSION_ZIP);
    if (code == EXR_ERR_SUCCESS)
        code = exr_attr_set_chromaticities(writer->context, 0, "chromaticities", &rec709);
    if (code == EXR_ERR_SUCCESS && tiled)
        code = exr_set_tile_descriptor(writer->context, 0, EXR_TILE_SIZE, EXR_TILE_SIZE,
                                       EXR_TILE_MIPMAP_LEVELS, EXR_TILE_ROUND_DOWN);
    if (code == EXR_ERR_SUCCESS && environment != LOBE_EXR_NO_ENVIRONMENT)
        code = exr_attr_set_envmap(writer->context, 0, "envmap",
                                   environment == LOBE_EXR_CUBE ? EXR_ENVMAP_CUBE
                                                                : EXR_ENVMAP_LATLONG);
    for (size_t index = 0; index < writer->channel_count && code == EXR_ERR_SUCCESS; index++) {
        const exr_channel *channel = &writer->channels[index];
        code = exr_add_channel(writer->context, 0, channel->name,
                               channel->layer->depth == LOBE_EXR_HALF ? EXR_PIXEL_HALF
                                                                      : EXR_PIXEL_FLOAT,
                               EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    return code;
}

static exr_result_t set_attribute(exr_context_t context, const lobe_exr_attribute *attribute) {
    switch (attribute->type) {
    case LOBE_EXR_TEXT:
        if (attribute->text == NULL)
            break;
        return exr_attr_set_string(context, 0, attribute->name, attribute->text);
    case LOBE_EXR_NUMBER:
        return exr_attr_set_float(context, 0, attribute->name, attribute->number);
    case LOBE_EXR_INTEGER:
        return exr_attr_set_int(context, 0, attribute->name, attribute->integer);
    }
    return EXR_ERR_INVALID_ARGUMENT;
}

static lobe_result add_attribute(const exr_writer *writer, const lobe_exr_attribute *attribute) {
    if (attribute->name == NULL || attribute->name[0] == '\0' ||
        strlen(attribute->name) > EXR_NAME_MAXIMUM_LENGTH)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: an attribute name must have 1 to %d bytes", writer->path,
                              EXR_NAME_MAXIMUM_LENGTH);
    const exr_attribute_t *existing;
    if (exr_get_attribute_by_name(writer->context, 0, attribute->name, &existing) ==
        EXR_ERR_SUCCESS)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: attribute '%s' exists already", writer->path, attribute->name);
    exr_result_t code = set_attribute(writer->context, attribute);
    return code == EXR_ERR_SUCCESS ? LOBE_OK : fail_from_library(writer, code, attribute->name);
}

/// Readers expect every level down to a single texel.
static lobe_result check_level_count(const exr_writer *writer) {
    int32_t count, rows;
    if (writer->level_count == 1)
        return LOBE_OK;
    exr_result_t code = exr_get_tile_levels(writer->context, 0, &count, &rows);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the levels");
    if (writer->level_count != (uint32_t)count)
        return lobe_host_fail(writer->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: %u levels are given, %ux%u texels have %d", writer->path,
                              writer->level_count, writer->width, writer->height, count);
    return LOBE_OK;
}

static lobe_result write_header(exr_writer *writer, const lobe_exr_parameters *parameters) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = ignore_error;
    settings.user_data = writer;
    settings.write_fn = write_output;
    settings.zip_level = ZIP_LEVEL;
    exr_result_t code =
        exr_start_write(&writer->context, writer->path, EXR_WRITE_FILE_DIRECTLY, &settings);
    if (code == EXR_ERR_SUCCESS)
        code = declare_image(writer, parameters->environment);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the header");
    lobe_result result = check_level_count(writer);
    for (size_t index = 0; index < parameters->attribute_count && result == LOBE_OK; index++)
        result = add_attribute(writer, &parameters->attributes[index]);
    if (result != LOBE_OK)
        return result;
    code = exr_write_header(writer->context);
    return code == EXR_ERR_SUCCESS ? LOBE_OK : fail_from_library(writer, code, "the header");
}

// ---------------------------------------------------------------------------------------------

static lobe_result finish(exr_writer *writer) {
    exr_result_t code = exr_finish(&writer->context);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the table of blocks");
    if (writer->clamped > 0)
        lobe_host_log(writer->host, LOBE_LOG_WARNING,
                      "%s: %zu values beyond the range of 16 bits were clamped to +-%.0f",
                      writer->path, writer->clamped, (double)ENGINE_HALF_MAXIMUM);
    return lobe_file_write(writer->path, writer->output.data, writer->output.size, writer->host);
}

static lobe_result encode(exr_writer *writer) {
    exr_result_t code = engine_exr_write_texels(writer);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the texels");
    engine_exr_free_texels(writer);
    return finish(writer);
}

lobe_result lobe_exr_write(const char *path, const lobe_exr_parameters *parameters,
                           const lobe_host *host) {
    if (!path || !parameters)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_exr_write: path and parameters must not be NULL");
    exr_writer writer = {.path = path, .host = host, .output.allocator = lobe_host_allocator(host)};
    lobe_result result = choose_extent(&writer, parameters);
    if (result == LOBE_OK)
        result = collect_channels(&writer, parameters);
    if (result == LOBE_OK)
        result = write_header(&writer, parameters);
    if (result == LOBE_OK)
        result = encode(&writer);
    engine_exr_free_texels(&writer);
    if (writer.context != NULL)
        exr_finish(&writer.context);
    engine_bytes_free(&writer.output);
    lobe_release(writer.channels);
    return result;
}
