#include "engine/image/exr/decode.h"

#include <string.h>

#include "engine/image/half.h"
#include "third_party/openexr.h"

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

/// Samples of a channel in row `y` of a block: only at coordinates that the sampling rate divides.
static int64_t samples_in_row(const exr_attr_chlist_entry_t *channel, const exr_block *block,
                              int64_t y) {
    if (y % channel->y_sampling != 0)
        return 0;
    return floor_divide(block->x + block->width - 1, channel->x_sampling) -
           floor_divide(block->x - 1, channel->x_sampling);
}

/// Bytes that a block unpacks to, from the channels in the header.
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

/// Texel (x, y) in the coordinates of the windows; NULL outside the display window.
static float *find_texel(const exr_reader *reader, int64_t x, int64_t y) {
    int64_t column = x - reader->display.x, row = y - reader->display.y;
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
        return exr_decoding_update(reader->input.context, reader->part, chunk, &reader->pipeline);
    exr_result_t code =
        exr_decoding_initialize(reader->input.context, reader->part, chunk, &reader->pipeline);
    reader->pipeline_started = code == EXR_ERR_SUCCESS;
    if (code == EXR_ERR_SUCCESS)
        code = exr_decoding_choose_default_routines(reader->input.context, reader->part,
                                                    &reader->pipeline);
    // OpenEXRCore reads and decompresses; the channels are separated here, where every size has
    // been checked.
    reader->pipeline.unpack_and_convert_fn = NULL;
    return code;
}

/// OpenEXRCore 3.1.5 does not compare a block's size in the file with what its channels need: it
/// would read past the end of a raw block that is too short, and write past a buffer for one that
/// is too long.
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
        return engine_exr_fail_damaged(&reader->input, "a block's size does not fit its channels");
    exr_result_t code = prepare_pipeline(reader, chunk);
    if (code == EXR_ERR_SUCCESS)
        code = exr_decoding_run(reader->input.context, reader->part, &reader->pipeline);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    place_block(reader, block);
    return LOBE_OK;
}

static lobe_result decode_scanlines(exr_reader *reader) {
    int32_t lines;
    exr_result_t code = exr_get_scanlines_per_chunk(reader->input.context, reader->part, &lines);
    if (code != EXR_ERR_SUCCESS || lines < 1)
        return engine_exr_fail(&reader->input, code);
    const exr_block *window = &reader->data;
    for (int64_t y = window->y; y < window->y + window->height; y += lines) {
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(reader->input.context, reader->part, (int)y, &chunk);
        if (code != EXR_ERR_SUCCESS)
            return engine_exr_fail(&reader->input, code);
        exr_block block = {window->x, y, chunk.width, chunk.height};
        lobe_result result = decode_block(reader, &chunk, &block);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

static lobe_result decode_tile(exr_reader *reader, int column, int row, int32_t width,
                               int32_t height) {
    exr_chunk_info_t chunk;
    exr_result_t code = exr_read_tile_chunk_info(reader->input.context, reader->part, column, row,
                                                 reader->level, reader->level, &chunk);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    exr_block block = {reader->data.x + (int64_t)column * width,
                       reader->data.y + (int64_t)row * height, chunk.width, chunk.height};
    return decode_block(reader, &chunk, &block);
}

static lobe_result decode_tiles(exr_reader *reader) {
    int32_t width, height;
    exr_result_t code = exr_get_tile_sizes(reader->input.context, reader->part, reader->level,
                                           reader->level, &width, &height);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    if (width < 1 || height < 1)
        return engine_exr_fail_damaged(&reader->input, "the size of the tiles is 0");
    for (int64_t row = 0; row * height < reader->data.height; row++) {
        for (int64_t column = 0; column * width < reader->data.width; column++) {
            lobe_result result = decode_tile(reader, (int)column, (int)row, width, height);
            if (result != LOBE_OK)
                return result;
        }
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// What OpenEXRCore cannot decompress

bool engine_exr_is_left_to_openexr(const exr_reader *reader) {
    exr_compression_t compression;
    return exr_get_compression(reader->input.context, reader->part, &compression) ==
               EXR_ERR_SUCCESS &&
           (compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB);
}

static void place_openexr_row(void *user, int y, const float *row) {
    const exr_reader *reader = user;
    for (int64_t column = 0; column < reader->data.width; column++) {
        float *texel = find_texel(reader, reader->data.x + column, y);
        if (texel != NULL)
            memcpy(texel, row + 4 * column, 4 * sizeof *row);
    }
}

/// OpenEXR reads each channel only once.
static void spread_grey(const exr_reader *reader) {
    float *texels = reader->image->texels;
    const size_t count = (size_t)reader->image->width * reader->image->height;
    for (size_t index = 0; index < count; index++)
        texels[4 * index + 1] = texels[4 * index + 2] = texels[4 * index];
}

static lobe_result decode_by_openexr(exr_reader *reader) {
    const bool grey = reader->sources[0] == reader->sources[1];
    openexr_source source = {.bytes = reader->input.data,
                             .size = reader->input.size,
                             .part = reader->part,
                             .place = place_openexr_row,
                             .user = reader};
    for (int component = 0; component < 4; component++) {
        const int index = reader->sources[component];
        if (index >= 0 && (!grey || component == 0 || component == 3))
            source.channels[component] = reader->channels->entries[index].name.str;
    }
    char message[OPENEXR_MESSAGE_SIZE];
    if (!third_party_openexr_read(&source, message))
        return engine_exr_fail_damaged(&reader->input, message);
    if (grey)
        spread_grey(reader);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------

exr_block engine_exr_block_of_window(const exr_attr_box2i_t *window) {
    return (exr_block){window->min.x, window->min.y, (int64_t)window->max.x - window->min.x + 1,
                       (int64_t)window->max.y - window->min.y + 1};
}

/// Levels start at the origin of the data window.
static lobe_result choose_level(exr_reader *reader, uint32_t level) {
    int32_t width, height;
    reader->level = (int)level;
    reader->data = engine_exr_block_of_window(&reader->data_window);
    reader->display = engine_exr_block_of_window(&reader->display_window);
    if (level == 0)
        return LOBE_OK;
    exr_result_t code = exr_get_level_sizes(reader->input.context, reader->part, reader->level,
                                            reader->level, &width, &height);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    reader->data.width = width;
    reader->data.height = height;
    reader->display = reader->data;
    return LOBE_OK;
}

lobe_result engine_exr_decode_level(exr_reader *reader, uint32_t level, lobe_image *image) {
    *image = (lobe_image){0};
    lobe_result result = choose_level(reader, level);
    if (result == LOBE_OK)
        result =
            lobe_image_allocate(image, LOBE_FORMAT_RGBA32_FLOAT, (uint32_t)reader->display.width,
                                (uint32_t)reader->display.height, reader->input.host);
    if (result != LOBE_OK)
        return result;
    reader->image = image;
    if (engine_exr_is_left_to_openexr(reader))
        return decode_by_openexr(reader);
    exr_storage_t storage;
    exr_result_t code = exr_get_storage(reader->input.context, reader->part, &storage);
    if (code != EXR_ERR_SUCCESS)
        return engine_exr_fail(&reader->input, code);
    return storage == EXR_STORAGE_TILED ? decode_tiles(reader) : decode_scanlines(reader);
}
