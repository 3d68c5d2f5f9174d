#include "engine/image/exr/encode.h"

#include <math.h>
#include <string.h>

#include "engine/image/half.h"

/// A block of texels: lines, or a tile of a level.
typedef struct exr_block {
    uint32_t level, x, y, width, height;
} exr_block;

static const lobe_image *level_of(const exr_channel *channel, uint32_t level) {
    return &channel->layer->image[level];
}

static bool is_half_format(const lobe_image *image) {
    return lobe_format_size(image->format) == 2 * lobe_format_channels(image->format);
}

static float load(const lobe_image *image, uint32_t component, size_t texel) {
    size_t index = texel * lobe_format_channels(image->format) + component;
    if (is_half_format(image))
        return engine_half_to_float(((const uint16_t *)image->texels)[index]);
    return ((const float *)image->texels)[index];
}

/// Rounds to half. Finite values that would become infinite are clamped and counted; infinite
/// values stay infinite.
static uint16_t round_to_half(float value, size_t *clamped) {
    uint16_t half = engine_half_from_float(value);
    bool overflow = (half & 0x7fffu) == 0x7c00u && isfinite(value);
    *clamped += overflow;
    return overflow ? engine_half_from_float(copysignf(ENGINE_HALF_MAXIMUM, value)) : half;
}

static size_t sample_size(const exr_channel *channel) {
    return channel->layer->depth == LOBE_EXR_HALF ? 2 : 4;
}

/// Fills `target` with the channel's texels of a block.
static void gather(exr_writer *writer, const exr_channel *channel, const exr_block *block,
                   uint8_t *target) {
    const lobe_image *image = level_of(channel, block->level);
    size_t count = 0;
    for (uint32_t row = 0; row < block->height; row++) {
        size_t first = (size_t)(block->y + row) * image->width + block->x;
        for (uint32_t column = 0; column < block->width; column++, count++) {
            float value = load(image, channel->component, first + column);
            if (channel->layer->depth == LOBE_EXR_HALF)
                ((uint16_t *)target)[count] = round_to_half(value, &writer->clamped);
            else
                ((float *)target)[count] = value;
        }
    }
}

/// A block contains its channels one after the other, each aligned for floats.
static size_t plane_size(const exr_channel *channel, const exr_block *block) {
    return ((size_t)block->height * block->width * sample_size(channel) + 3) & ~(size_t)3;
}

static exr_result_t reserve(exr_writer *writer, const exr_block *block) {
    size_t size = 0;
    for (size_t index = 0; index < writer->channel_count; index++)
        size += plane_size(&writer->channels[index], block);
    if (size <= writer->block_size)
        return EXR_ERR_SUCCESS;
    lobe_release(writer->block);
    writer->block = lobe_allocate(lobe_host_allocator(writer->host), size, 1);
    writer->block_size = writer->block != NULL ? size : 0;
    return writer->block != NULL ? EXR_ERR_SUCCESS : EXR_ERR_OUT_OF_MEMORY;
}

static exr_result_t prepare_pipeline(exr_writer *writer, const exr_chunk_info_t *chunk) {
    if (writer->pipeline_started)
        return exr_encoding_update(writer->context, 0, chunk, &writer->pipeline);
    exr_result_t code = exr_encoding_initialize(writer->context, 0, chunk, &writer->pipeline);
    writer->pipeline_started = code == EXR_ERR_SUCCESS;
    return code;
}

static void connect_channels(exr_writer *writer, const exr_block *block) {
    uint8_t *plane = writer->block;
    for (size_t index = 0; index < writer->channel_count; index++) {
        const exr_channel *channel = &writer->channels[index];
        exr_coding_channel_info_t *target = &writer->pipeline.channels[index];
        gather(writer, channel, block, plane);
        target->user_data_type = target->data_type;
        target->user_bytes_per_element = (int16_t)sample_size(channel);
        target->user_pixel_stride = (int32_t)sample_size(channel);
        target->user_line_stride = (int32_t)(sample_size(channel) * block->width);
        target->encode_from_ptr = plane;
        plane += plane_size(channel, block);
    }
}

/// A block that does not shrink is stored raw, which readers recognise by its size.
/// OpenEXRCore 3.1.5 does not handle a compressed block that has exactly that size.
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

static exr_result_t write_block(exr_writer *writer, const exr_chunk_info_t *chunk,
                                const exr_block *block) {
    bool first = !writer->pipeline_started;
    exr_result_t code = reserve(writer, block);
    if (code == EXR_ERR_SUCCESS)
        code = prepare_pipeline(writer, chunk);
    if (code != EXR_ERR_SUCCESS)
        return code;
    connect_channels(writer, block);
    if (first)
        code = choose_routines(writer);
    if (code == EXR_ERR_SUCCESS)
        code = exr_encoding_run(writer->context, 0, &writer->pipeline);
    return code;
}

static uint32_t minimum(uint32_t left, uint32_t right) {
    return left < right ? left : right;
}

static exr_result_t write_scanlines(exr_writer *writer) {
    int32_t lines;
    exr_result_t code = exr_get_scanlines_per_chunk(writer->context, 0, &lines);
    for (uint32_t row = 0; row < writer->height && code == EXR_ERR_SUCCESS;
         row += (uint32_t)lines) {
        exr_block block = {.y = row,
                           .width = writer->width,
                           .height = minimum(writer->height - row, (uint32_t)lines)};
        exr_chunk_info_t chunk;
        code = exr_write_scanline_chunk_info(writer->context, 0, (int)row, &chunk);
        if (code == EXR_ERR_SUCCESS)
            code = write_block(writer, &chunk, &block);
    }
    return code;
}

/// OpenEXRCore 3.1.5 cuts off tiles at the edges of the finest level only.
static void cut_tile(exr_chunk_info_t *chunk, const exr_block *tile) {
    uint64_t texel = chunk->unpacked_size / ((uint64_t)chunk->width * (uint64_t)chunk->height);
    chunk->width = (int32_t)tile->width;
    chunk->height = (int32_t)tile->height;
    chunk->unpacked_size = texel * tile->width * tile->height;
}

static exr_result_t write_tile(exr_writer *writer, const exr_block *tile, int column, int row) {
    exr_chunk_info_t chunk;
    int level = (int)tile->level;
    exr_result_t code =
        exr_write_tile_chunk_info(writer->context, 0, column, row, level, level, &chunk);
    if (code != EXR_ERR_SUCCESS)
        return code;
    cut_tile(&chunk, tile);
    return write_block(writer, &chunk, tile);
}

static exr_result_t write_level(exr_writer *writer, uint32_t level) {
    const lobe_image *image = level_of(&writer->channels[0], level);
    exr_result_t code = EXR_ERR_SUCCESS;
    const uint32_t size = EXR_TILE_SIZE;
    for (uint32_t y = 0; y < image->height && code == EXR_ERR_SUCCESS; y += size) {
        for (uint32_t x = 0; x < image->width && code == EXR_ERR_SUCCESS; x += size) {
            exr_block tile = {level, x, y, minimum(image->width - x, size),
                              minimum(image->height - y, size)};
            code = write_tile(writer, &tile, (int)(x / size), (int)(y / size));
        }
    }
    return code;
}

exr_result_t engine_exr_write_texels(exr_writer *writer) {
    if (writer->level_count <= 1)
        return write_scanlines(writer);
    exr_result_t code = EXR_ERR_SUCCESS;
    for (uint32_t level = 0; level < writer->level_count && code == EXR_ERR_SUCCESS; level++)
        code = write_level(writer, level);
    return code;
}

void engine_exr_free_texels(exr_writer *writer) {
    if (writer->pipeline_started)
        exr_encoding_destroy(writer->context, &writer->pipeline);
    writer->pipeline_started = false;
    lobe_release(writer->block);
    writer->block = NULL;
    writer->block_size = 0;
}
