#include <lobe/exr.h>

#include <math.h>
#include <openexr.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>

#include "engine/bytes.h"
#include "engine/half.h"

/// A fixed level, so that the bytes do not depend on the process's defaults.
#define ZIP_LEVEL           4
#define NAME_MAXIMUM_LENGTH 255

typedef struct exr_channel {
    char name[NAME_MAXIMUM_LENGTH + 1];
    const lobe_exr_layer *layer;
    uint32_t component; ///< of the layer's image
} exr_channel;

typedef struct exr_writer {
    const char *path;
    const lobe_log *log;
    uint32_t width, height;
    exr_channel *channels; ///< sorted by name, as the format demands
    size_t channel_count;
    engine_bytes output;
    exr_context_t context;
    exr_encode_pipeline_t pipeline;
    bool pipeline_started;
    exr_result_t (*compress)(exr_encode_pipeline_t *pipeline); ///< OpenEXRCore's own
    uint8_t *block;     ///< texels of one block, channel after channel
    size_t clamped;     ///< values beyond the range of half
    bool out_of_memory; ///< while growing `output`
} exr_writer;

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
    if (name[0] == '\0' || length > NAME_MAXIMUM_LENGTH)
        return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                             "%s: a channel name must have 1 to %d bytes", writer->path,
                             NAME_MAXIMUM_LENGTH);
    channel->layer = layer;
    channel->component = component;
    return LOBE_OK;
}

static lobe_result add_layer(exr_writer *writer, const lobe_exr_layer *layer) {
    const lobe_image *image = layer->image;
    const char *layer_name = layer->name != NULL ? layer->name : "main";
    if (!is_float_format(image->format))
        return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                             "%s: layer '%s' has format %s, which is not a float format",
                             writer->path, layer_name, lobe_format_name(image->format));
    if (image->width != writer->width || image->height != writer->height)
        return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                             "%s: layer '%s' has %ux%u texels, the first layer %ux%u", writer->path,
                             layer_name, image->width, image->height, writer->width,
                             writer->height);
    const char *const *names = channel_names(layer);
    lobe_result result = LOBE_OK;
    for (uint32_t component = 0; component < 4 && result == LOBE_OK; component++) {
        if (names[component] == NULL)
            continue;
        if (component >= lobe_format_channels(image->format))
            return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                                 "%s: layer '%s' names more channels than %s has", writer->path,
                                 layer_name, lobe_format_name(image->format));
        result = add_channel(writer, layer, component, names[component]);
    }
    return result;
}

static int compare_channels(const void *left, const void *right) {
    return strcmp(((const exr_channel *)left)->name, ((const exr_channel *)right)->name);
}

static lobe_result collect_channels(exr_writer *writer, const lobe_exr_parameters *parameters) {
    if (parameters->layer_count == 0)
        return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT, "%s: no layer to write",
                             writer->path);
    writer->width = parameters->layers[0].image->width;
    writer->height = parameters->layers[0].image->height;
    writer->channels = calloc(4 * parameters->layer_count, sizeof *writer->channels);
    if (writer->channels == NULL)
        return lobe_log_fail(writer->log, LOBE_ERROR_OUT_OF_MEMORY, "%s: no memory to encode it",
                             writer->path);
    for (size_t index = 0; index < parameters->layer_count; index++) {
        lobe_result result = add_layer(writer, &parameters->layers[index]);
        if (result != LOBE_OK)
            return result;
    }
    qsort(writer->channels, writer->channel_count, sizeof *writer->channels, compare_channels);
    for (size_t index = 1; index < writer->channel_count; index++) {
        if (compare_channels(&writer->channels[index - 1], &writer->channels[index]) == 0)
            return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                                 "%s: channel '%s' is there twice", writer->path,
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
    return lobe_log_fail(writer->log,
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

static exr_result_t declare_image(exr_writer *writer) {
    int part;
    exr_result_t code = exr_set_longname_support(writer->context, 1);
    if (code == EXR_ERR_SUCCESS)
        code = exr_add_part(writer->context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(writer->context, 0, (int32_t)writer->width,
                                                   (int32_t)writer->height, EXR_COMPRESSION_ZIP);
    if (code == EXR_ERR_SUCCESS)
        code = exr_attr_set_chromaticities(writer->context, 0, "chromaticities", &rec709);
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
        strlen(attribute->name) > NAME_MAXIMUM_LENGTH)
        return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                             "%s: an attribute name must have 1 to %d bytes", writer->path,
                             NAME_MAXIMUM_LENGTH);
    const exr_attribute_t *existing;
    if (exr_get_attribute_by_name(writer->context, 0, attribute->name, &existing) ==
        EXR_ERR_SUCCESS)
        return lobe_log_fail(writer->log, LOBE_ERROR_INVALID_ARGUMENT,
                             "%s: attribute '%s' is already there", writer->path, attribute->name);
    exr_result_t code = set_attribute(writer->context, attribute);
    return code == EXR_ERR_SUCCESS ? LOBE_OK : fail_from_library(writer, code, attribute->name);
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
        code = declare_image(writer);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the header");
    for (size_t index = 0; index < parameters->attribute_count; index++) {
        lobe_result result = add_attribute(writer, &parameters->attributes[index]);
        if (result != LOBE_OK)
            return result;
    }
    code = exr_write_header(writer->context);
    return code == EXR_ERR_SUCCESS ? LOBE_OK : fail_from_library(writer, code, "the header");
}

// ---------------------------------------------------------------------------------------------
// Texels

static bool is_half_format(const lobe_image *image) {
    return lobe_format_size(image->format) == 2 * lobe_format_channels(image->format);
}

static float load(const exr_channel *channel, size_t texel) {
    const lobe_image *image = channel->layer->image;
    size_t index = texel * lobe_format_channels(image->format) + channel->component;
    if (is_half_format(image))
        return engine_half_to_float(((const uint16_t *)image->texels)[index]);
    return ((const float *)image->texels)[index];
}

/// Rounds to half. What would become infinite by rounding is clamped and counted; what is
/// infinite already stays so.
static uint16_t round_to_half(float value, size_t *clamped) {
    uint16_t half = engine_half_from_float(value);
    bool overflow = (half & 0x7fffu) == 0x7c00u && isfinite(value);
    *clamped += overflow;
    return overflow ? engine_half_from_float(copysignf(ENGINE_HALF_MAXIMUM, value)) : half;
}

static size_t sample_size(const exr_channel *channel) {
    return channel->layer->depth == LOBE_EXR_HALF ? 2 : 4;
}

/// Fills `target` with the channel's texels from row `row` on.
static void gather(exr_writer *writer, const exr_channel *channel, uint32_t row, uint32_t rows,
                   uint8_t *target) {
    size_t first = (size_t)row * writer->width, count = (size_t)rows * writer->width;
    for (size_t index = 0; index < count; index++) {
        float value = load(channel, first + index);
        if (channel->layer->depth == LOBE_EXR_HALF)
            ((uint16_t *)target)[index] = round_to_half(value, &writer->clamped);
        else
            ((float *)target)[index] = value;
    }
}

/// A block holds its channels one after the other, each at an address that suits floats.
static size_t plane_size(const exr_writer *writer, const exr_channel *channel, uint32_t rows) {
    return ((size_t)rows * writer->width * sample_size(channel) + 3) & ~(size_t)3;
}

static exr_result_t prepare_pipeline(exr_writer *writer, const exr_chunk_info_t *chunk) {
    if (writer->pipeline_started)
        return exr_encoding_update(writer->context, 0, chunk, &writer->pipeline);
    exr_result_t code = exr_encoding_initialize(writer->context, 0, chunk, &writer->pipeline);
    writer->pipeline_started = code == EXR_ERR_SUCCESS;
    return code;
}

static void connect_channels(exr_writer *writer, uint32_t row, uint32_t rows) {
    uint8_t *plane = writer->block;
    for (size_t index = 0; index < writer->channel_count; index++) {
        const exr_channel *channel = &writer->channels[index];
        exr_coding_channel_info_t *target = &writer->pipeline.channels[index];
        gather(writer, channel, row, rows, plane);
        target->user_data_type = target->data_type;
        target->user_bytes_per_element = (int16_t)sample_size(channel);
        target->user_pixel_stride = (int32_t)sample_size(channel);
        target->user_line_stride = (int32_t)(sample_size(channel) * writer->width);
        target->encode_from_ptr = plane;
        plane += plane_size(writer, channel, rows);
    }
}

/// A block that does not shrink is stored raw, and readers know it by its size. OpenEXRCore 3.1.5
/// overlooks that a compressed block may come out at just that size.
static exr_result_t compress(exr_encode_pipeline_t *pipeline) {
    const exr_writer *writer = pipeline->encoding_user_data;
    exr_result_t code = writer->compress(pipeline);
    if (code == EXR_ERR_SUCCESS && pipeline->compressed_bytes == pipeline->packed_bytes)
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    return code;
}

static exr_result_t choose_routines(exr_writer *writer) {
    exr_result_t code = exr_encoding_choose_default_routines(writer->context, 0, &writer->pipeline);
    writer->compress = writer->pipeline.compress_fn;
    writer->pipeline.compress_fn = compress;
    writer->pipeline.encoding_user_data = writer;
    return code;
}

static exr_result_t write_block(exr_writer *writer, uint32_t row, uint32_t rows) {
    exr_chunk_info_t chunk;
    exr_result_t code = exr_write_scanline_chunk_info(writer->context, 0, (int)row, &chunk);
    if (code == EXR_ERR_SUCCESS)
        code = prepare_pipeline(writer, &chunk);
    if (code != EXR_ERR_SUCCESS)
        return code;
    connect_channels(writer, row, rows);
    if (row == 0)
        code = choose_routines(writer);
    if (code == EXR_ERR_SUCCESS)
        code = exr_encoding_run(writer->context, 0, &writer->pipeline);
    return code;
}

static lobe_result write_texels(exr_writer *writer) {
    int32_t lines;
    exr_result_t code = exr_get_scanlines_per_chunk(writer->context, 0, &lines);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the texels");
    size_t size = 0;
    for (size_t index = 0; index < writer->channel_count; index++)
        size += plane_size(writer, &writer->channels[index], (uint32_t)lines);
    writer->block = malloc(size);
    if (writer->block == NULL)
        return fail_from_library(writer, EXR_ERR_OUT_OF_MEMORY, "the texels");
    for (uint32_t row = 0; row < writer->height && code == EXR_ERR_SUCCESS;
         row += (uint32_t)lines) {
        uint32_t left = writer->height - row;
        code = write_block(writer, row, left < (uint32_t)lines ? left : (uint32_t)lines);
    }
    return code == EXR_ERR_SUCCESS ? LOBE_OK : fail_from_library(writer, code, "the texels");
}

// ---------------------------------------------------------------------------------------------

static lobe_result finish(exr_writer *writer) {
    exr_result_t code = exr_finish(&writer->context);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(writer, code, "the table of blocks");
    if (writer->clamped > 0)
        lobe_log_print(writer->log, LOBE_LOG_WARNING,
                       "%s: %zu values beyond the range of 16 bits were clamped to +-%.0f",
                       writer->path, writer->clamped, (double)ENGINE_HALF_MAXIMUM);
    return lobe_file_write(writer->path, writer->output.data, writer->output.size, writer->log);
}

lobe_result lobe_exr_write(const char *path, const lobe_exr_parameters *parameters,
                           const lobe_log *log) {
    exr_writer writer = {.path = path, .log = log};
    lobe_result result = collect_channels(&writer, parameters);
    if (result == LOBE_OK)
        result = write_header(&writer, parameters);
    if (result == LOBE_OK)
        result = write_texels(&writer);
    if (writer.pipeline_started)
        exr_encoding_destroy(writer.context, &writer.pipeline);
    if (result == LOBE_OK)
        result = finish(&writer);
    if (writer.context != NULL)
        exr_finish(&writer.context);
    engine_bytes_free(&writer.output);
    free(writer.channels);
    free(writer.block);
    return result;
}
