#include <lobe/exr.h>

#include <openexr.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/file.h>

#include "engine/half.h"

/// Most bytes that one block of a file may unpack to; real ones stay far below.
#define BLOCK_MAXIMUM_SIZE ((uint64_t)1 << 30)

/// A file in memory, for OpenEXRCore's callbacks.
typedef struct exr_input {
    uint8_t *data;
    size_t size;
    char message[200]; ///< the first thing OpenEXRCore complained about, usually the most precise
} exr_input;

typedef struct exr_reader {
    const char *path;
    const lobe_log *log;
    exr_input input;
    exr_context_t context;
    int part;
    const exr_attr_chlist_t *channels;
    int sources[4]; ///< for R, G, B, A: index into `channels`; -1: none
    exr_attr_box2i_t data_window, display_window;
    exr_decode_pipeline_t pipeline;
    bool pipeline_started;
    lobe_image *image;
} exr_reader;

/// A block of texels in the coordinates of the windows.
typedef struct exr_block {
    int64_t x, y, width, height;
} exr_block;

// ---------------------------------------------------------------------------------------------
// Callbacks and errors

static int64_t read_input(exr_const_context_t context, void *user, void *buffer, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t report) {
    (void)context;
    (void)report;
    const exr_input *input = user;
    if (offset >= input->size)
        return 0;
    uint64_t available = input->size - offset;
    uint64_t count = size < available ? size : available;
    memcpy(buffer, input->data + offset, count);
    return (int64_t)count;
}

static int64_t input_size(exr_const_context_t context, void *user) {
    (void)context;
    return (int64_t)((const exr_input *)user)->size;
}

static void remember_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)code;
    void *user = NULL;
    if (context == NULL || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS)
        return;
    exr_input *input = user;
    if (input->message[0] == '\0')
        snprintf(input->message, sizeof input->message, "%s", message);
}

/// Messages quote bytes of the file: keep the log's one line to printable ASCII.
static void make_printable(char *text) {
    for (; *text != '\0'; text++) {
        if (*text < ' ' || *text > '~')
            *text = '?';
    }
}

/// OpenEXRCore's decoders also say "out of memory" where a block ends too early.
static bool is_out_of_memory(exr_result_t code, const char *message) {
    return code == EXR_ERR_OUT_OF_MEMORY && strstr(message, "allocate") != NULL;
}

static lobe_result fail_from_library(exr_reader *reader, exr_result_t code) {
    make_printable(reader->input.message);
    const char *message = reader->input.message[0] != '\0' ? reader->input.message
                                                           : exr_get_default_error_message(code);
    if (is_out_of_memory(code, message))
        return lobe_log_fail(reader->log, LOBE_ERROR_OUT_OF_MEMORY, "%s: no memory to decode it",
                             reader->path);
    bool unsupported = code == EXR_ERR_FEATURE_NOT_IMPLEMENTED;
    return lobe_log_fail(reader->log, unsupported ? LOBE_ERROR_UNSUPPORTED : LOBE_ERROR_MALFORMED,
                         "%s: %s OpenEXR file: %s", reader->path,
                         unsupported ? "unsupported" : "damaged", message);
}

static lobe_result fail_damaged(const exr_reader *reader, const char *cause) {
    return lobe_log_fail(reader->log, LOBE_ERROR_MALFORMED, "%s: damaged OpenEXR file: %s",
                         reader->path, cause);
}

// ---------------------------------------------------------------------------------------------
// Which channels

/// What a channel is called within the layer; NULL where it belongs to another.
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

/// The layer's one channel beside alpha; -1 where there are none or several.
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
    return exr_get_storage(reader->context, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

/// Looks for the layer as a prefix of channel names; with `as_part` as the name of a part.
static bool find_part(exr_reader *reader, const char *layer, bool as_part) {
    int count = 0;
    exr_get_count(reader->context, &count);
    for (int part = 0; part < count; part++) {
        const char *name = NULL;
        if (as_part && (exr_get_name(reader->context, part, &name) != EXR_ERR_SUCCESS ||
                        name == NULL || strcmp(name, layer) != 0))
            continue;
        if (is_flat(reader, part) &&
            exr_get_channels(reader->context, part, &reader->channels) == EXR_ERR_SUCCESS &&
            find_sources(reader->channels, as_part ? NULL : layer, reader->sources)) {
            reader->part = part;
            return true;
        }
    }
    return false;
}

static bool has_flat_part(const exr_reader *reader) {
    int count = 0;
    exr_get_count(reader->context, &count);
    for (int part = 0; part < count; part++) {
        if (is_flat(reader, part))
            return true;
    }
    return false;
}

static lobe_result choose_channels(exr_reader *reader, const char *layer) {
    if (!has_flat_part(reader))
        return lobe_log_fail(reader->log, LOBE_ERROR_UNSUPPORTED,
                             "%s: deep OpenEXR data is not supported", reader->path);
    if (!find_part(reader, layer, false) && (layer == NULL || !find_part(reader, layer, true))) {
        if (layer != NULL)
            return lobe_log_fail(reader->log, LOBE_ERROR_NOT_FOUND, "%s: has no layer '%s'",
                                 reader->path, layer);
        return lobe_log_fail(reader->log, LOBE_ERROR_UNSUPPORTED,
                             "%s: has neither channels R, G, B nor Y", reader->path);
    }
    for (int index = 0; index < reader->channels->num_channels; index++) {
        if (reader->channels->entries[index].x_sampling < 1 ||
            reader->channels->entries[index].y_sampling < 1)
            return fail_damaged(reader, "a channel without sampling rate");
    }
    for (int component = 0; component < 4; component++) {
        int source = reader->sources[component];
        if (source >= 0 && (reader->channels->entries[source].x_sampling != 1 ||
                            reader->channels->entries[source].y_sampling != 1))
            return lobe_log_fail(reader->log, LOBE_ERROR_UNSUPPORTED,
                                 "%s: subsampled channels are not supported", reader->path);
    }
    if (find_channel(reader->channels, NULL, "RY") >= 0)
        lobe_log_print(reader->log, LOBE_LOG_WARNING,
                       "%s: colour differences RY and BY are ignored, the image is read as grey",
                       reader->path);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Sizes, before anything is allocated

static exr_block block_of_window(const exr_attr_box2i_t *window) {
    return (exr_block){window->min.x, window->min.y, (int64_t)window->max.x - window->min.x + 1,
                       (int64_t)window->max.y - window->min.y + 1};
}

static lobe_result check_window(const exr_reader *reader, const exr_attr_box2i_t *window,
                                const char *name) {
    exr_block block = block_of_window(window);
    if (block.width < 1 || block.height < 1)
        return lobe_log_fail(reader->log, LOBE_ERROR_MALFORMED,
                             "%s: damaged OpenEXR file: the %s window is empty", reader->path,
                             name);
    if (block.width > LOBE_IMAGE_MAXIMUM_EXTENT || block.height > LOBE_IMAGE_MAXIMUM_EXTENT ||
        (uint64_t)block.width * (uint64_t)block.height > LOBE_EXR_MAXIMUM_TEXELS)
        return lobe_log_fail(reader->log, LOBE_ERROR_LIMIT,
                             "%s: the %s window of %lldx%lld texels is too large", reader->path,
                             name, (long long)block.width, (long long)block.height);
    return LOBE_OK;
}

static lobe_result check_sizes(exr_reader *reader) {
    uint64_t block_size = 0;
    reader->input.message[0] = '\0'; // forget that a part had no name
    exr_result_t code = exr_get_data_window(reader->context, reader->part, &reader->data_window);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_display_window(reader->context, reader->part, &reader->display_window);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_chunk_unpacked_size(reader->context, reader->part, &block_size);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(reader, code);
    lobe_result result = check_window(reader, &reader->data_window, "data");
    if (result == LOBE_OK)
        result = check_window(reader, &reader->display_window, "display");
    if (result == LOBE_OK && block_size > BLOCK_MAXIMUM_SIZE)
        return lobe_log_fail(reader->log, LOBE_ERROR_LIMIT,
                             "%s: blocks of %llu bytes are too large", reader->path,
                             (unsigned long long)block_size);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Texels

static uint32_t load_little_endian(const uint8_t *bytes, int count) {
    uint32_t value = 0;
    for (int index = 0; index < count; index++)
        value |= (uint32_t)bytes[index] << (8 * index);
    return value;
}

static float load_sample(const uint8_t *bytes, exr_pixel_type_t type) {
    if (type == EXR_PIXEL_HALF)
        return engine_half_to_float((uint16_t)load_little_endian(bytes, 2));
    uint32_t bits = load_little_endian(bytes, 4);
    if (type == EXR_PIXEL_UINT)
        return (float)bits;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static size_t sample_size(const exr_attr_chlist_entry_t *channel) {
    return channel->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
}

static int64_t floor_divide(int64_t value, int64_t divisor) {
    return value / divisor - (value % divisor < 0);
}

/// Samples of a channel in row `y` of a block: only coordinates that the sampling divides.
static int64_t samples_in_row(const exr_attr_chlist_entry_t *channel, const exr_block *block,
                              int64_t y) {
    if (y % channel->y_sampling != 0)
        return 0;
    return floor_divide(block->x + block->width - 1, channel->x_sampling) -
           floor_divide(block->x - 1, channel->x_sampling);
}

/// What a block unpacks to when its channels are what the header says.
static uint64_t unpacked_size(const exr_reader *reader, const exr_block *block) {
    uint64_t size = 0;
    for (int64_t y = block->y; y < block->y + block->height; y++) {
        for (int index = 0; index < reader->channels->num_channels; index++) {
            const exr_attr_chlist_entry_t *channel = &reader->channels->entries[index];
            size += (uint64_t)samples_in_row(channel, block, y) * sample_size(channel);
        }
    }
    return size;
}

/// Texel (x, y) of the windows' coordinates; NULL outside the display window.
static float *find_texel(const exr_reader *reader, int64_t x, int64_t y) {
    int64_t column = x - reader->display_window.min.x, row = y - reader->display_window.min.y;
    if (column < 0 || row < 0 || column >= reader->image->width || row >= reader->image->height)
        return NULL;
    return (float *)reader->image->texels + 4 * (row * reader->image->width + column);
}

static void place_row(const exr_reader *reader, const exr_block *block, int64_t y, int channel,
                      const uint8_t *samples) {
    exr_pixel_type_t type = reader->channels->entries[channel].pixel_type;
    size_t size = sample_size(&reader->channels->entries[channel]);
    for (int component = 0; component < 4; component++) {
        if (reader->sources[component] != channel)
            continue;
        for (int64_t column = 0; column < block->width; column++) {
            float *texel = find_texel(reader, block->x + column, y);
            if (texel != NULL)
                texel[component] = load_sample(samples + column * size, type);
        }
    }
}

static void set_opaque(const exr_reader *reader, const exr_block *block) {
    for (int64_t y = block->y; y < block->y + block->height; y++) {
        for (int64_t x = block->x; x < block->x + block->width; x++) {
            float *texel = find_texel(reader, x, y);
            if (texel != NULL)
                texel[3] = 1.0f;
        }
    }
}

/// In an unpacked block each row holds all samples of the first channel, then of the second, ...
static void place_block(const exr_reader *reader, const exr_block *block) {
    const uint8_t *samples = reader->pipeline.unpacked_buffer;
    for (int64_t y = block->y; y < block->y + block->height; y++) {
        for (int index = 0; index < reader->channels->num_channels; index++) {
            const exr_attr_chlist_entry_t *channel = &reader->channels->entries[index];
            int64_t count = samples_in_row(channel, block, y);
            if (count > 0)
                place_row(reader, block, y, index, samples);
            samples += (size_t)count * sample_size(channel);
        }
    }
    if (reader->sources[3] < 0)
        set_opaque(reader, block);
}

static exr_result_t prepare_pipeline(exr_reader *reader, const exr_chunk_info_t *chunk) {
    if (reader->pipeline_started)
        return exr_decoding_update(reader->context, reader->part, chunk, &reader->pipeline);
    exr_result_t code =
        exr_decoding_initialize(reader->context, reader->part, chunk, &reader->pipeline);
    reader->pipeline_started = code == EXR_ERR_SUCCESS;
    if (code == EXR_ERR_SUCCESS)
        code =
            exr_decoding_choose_default_routines(reader->context, reader->part, &reader->pipeline);
    // Reading and unpacking is OpenEXRCore's work; sorting out the channels is done here, where
    // every size has been checked.
    reader->pipeline.unpack_and_convert_fn = NULL;
    return code;
}

/// OpenEXRCore 3.1.5 does not compare a block's size in the file with what its own channels need:
/// a shorter raw block would be read past its end, a longer one written past a buffer.
static bool is_consistent(const exr_reader *reader, const exr_chunk_info_t *chunk,
                          const exr_block *block) {
    return chunk->unpacked_size == unpacked_size(reader, block) && chunk->packed_size > 0 &&
           chunk->packed_size <= chunk->unpacked_size &&
           (chunk->compression != EXR_COMPRESSION_NONE ||
            chunk->packed_size == chunk->unpacked_size);
}

static lobe_result decode_block(exr_reader *reader, const exr_chunk_info_t *chunk,
                                const exr_block *block) {
    if (chunk->unpacked_size == 0)
        return LOBE_OK;
    if (!is_consistent(reader, chunk, block))
        return fail_damaged(reader, "a block's size does not fit its channels");
    exr_result_t code = prepare_pipeline(reader, chunk);
    if (code == EXR_ERR_SUCCESS)
        code = exr_decoding_run(reader->context, reader->part, &reader->pipeline);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(reader, code);
    place_block(reader, block);
    return LOBE_OK;
}

static lobe_result decode_scanlines(exr_reader *reader) {
    int32_t lines;
    exr_result_t code = exr_get_scanlines_per_chunk(reader->context, reader->part, &lines);
    if (code != EXR_ERR_SUCCESS || lines < 1)
        return fail_from_library(reader, code);
    const exr_attr_box2i_t *window = &reader->data_window;
    for (int64_t y = window->min.y; y <= window->max.y; y += lines) {
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(reader->context, reader->part, (int)y, &chunk);
        if (code != EXR_ERR_SUCCESS)
            return fail_from_library(reader, code);
        exr_block block = {window->min.x, y, chunk.width, chunk.height};
        lobe_result result = decode_block(reader, &chunk, &block);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

static lobe_result decode_tile(exr_reader *reader, int column, int row, int32_t width,
                               int32_t height) {
    exr_chunk_info_t chunk;
    exr_result_t code =
        exr_read_tile_chunk_info(reader->context, reader->part, column, row, 0, 0, &chunk);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(reader, code);
    exr_block block = {reader->data_window.min.x + (int64_t)column * width,
                       reader->data_window.min.y + (int64_t)row * height, chunk.width,
                       chunk.height};
    return decode_block(reader, &chunk, &block);
}

static lobe_result decode_tiles(exr_reader *reader) {
    int32_t width, height;
    exr_result_t code = exr_get_tile_sizes(reader->context, reader->part, 0, 0, &width, &height);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(reader, code);
    if (width < 1 || height < 1)
        return fail_damaged(reader, "tiles without extent");
    exr_block window = block_of_window(&reader->data_window);
    for (int64_t row = 0; row * height < window.height; row++) {
        for (int64_t column = 0; column * width < window.width; column++) {
            lobe_result result = decode_tile(reader, (int)column, (int)row, width, height);
            if (result != LOBE_OK)
                return result;
        }
    }
    return LOBE_OK;
}

static lobe_result decode(exr_reader *reader) {
    exr_block display = block_of_window(&reader->display_window);
    lobe_result result =
        lobe_image_allocate(reader->image, LOBE_FORMAT_RGBA32_FLOAT, (uint32_t)display.width,
                            (uint32_t)display.height, reader->log);
    if (result != LOBE_OK)
        return result;
    exr_storage_t storage;
    exr_result_t code = exr_get_storage(reader->context, reader->part, &storage);
    if (code != EXR_ERR_SUCCESS)
        return fail_from_library(reader, code);
    return storage == EXR_STORAGE_TILED ? decode_tiles(reader) : decode_scanlines(reader);
}

// ---------------------------------------------------------------------------------------------

static lobe_result open_context(exr_reader *reader) {
    static const uint8_t magic[4] = {0x76, 0x2f, 0x31, 0x01};
    if (reader->input.size < 4 || memcmp(reader->input.data, magic, 4) != 0)
        return lobe_log_fail(reader->log, LOBE_ERROR_MALFORMED, "%s: not an OpenEXR file",
                             reader->path);
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = remember_error;
    settings.user_data = &reader->input;
    settings.read_fn = read_input;
    settings.size_fn = input_size;
    // A file without its table of blocks was cut off while it was written: say so, do not guess.
    settings.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    exr_result_t code = exr_start_read(&reader->context, reader->path, &settings);
    return code == EXR_ERR_SUCCESS ? LOBE_OK : fail_from_library(reader, code);
}

lobe_result lobe_exr_read(const char *path, const char *layer, const lobe_log *log,
                          lobe_image *image) {
    *image = (lobe_image){0};
    exr_reader reader = {.path = path, .log = log, .image = image};
    lobe_result result = lobe_file_read(path, NULL, log, &reader.input.data, &reader.input.size);
    if (result == LOBE_OK)
        result = open_context(&reader);
    if (result == LOBE_OK)
        result = choose_channels(&reader, layer);
    if (result == LOBE_OK)
        result = check_sizes(&reader);
    if (result == LOBE_OK)
        result = decode(&reader);
    if (result != LOBE_OK)
        lobe_image_free(image);
    if (reader.pipeline_started)
        exr_decoding_destroy(reader.context, &reader.pipeline);
    if (reader.context != NULL)
        exr_finish(&reader.context);
    free(reader.input.data);
    return result;
}
