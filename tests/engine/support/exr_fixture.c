#include "tests/engine/support/exr_fixture.h"

#include <stdlib.h>
#include <string.h>

#include "engine/image/half.h"
#include "tests/engine/support/cmocka_all.h"

typedef struct block {
    int x, y, width, height, level;
} block;

float exr_fixture_value(int channel, int x, int y) {
    unsigned mixed = (unsigned)(x + 100) * 31u + (unsigned)(y + 100) * 17u;
    return (float)(mixed % 61u + 64u * (unsigned)channel);
}

static void must(exr_result_t code) {
    assert_int_equal(code, EXR_ERR_SUCCESS);
}

static size_t store(void *target, exr_pixel_type_t type, float value) {
    uint16_t half = engine_half_from_float(value);
    uint32_t whole = value > 0.0f ? (uint32_t)value : 0;
    const void *source = type == EXR_PIXEL_HALF   ? (const void *)&half
                         : type == EXR_PIXEL_UINT ? (const void *)&whole
                                                  : (const void *)&value;
    size_t size = type == EXR_PIXEL_HALF ? 2 : 4;
    memcpy(target, source, size);
    return size;
}

/// The samples of a channel in a block: those whose coordinates the sampling divides.
static uint8_t *fill_plane(const exr_fixture_channel *channel, int index, const block *block) {
    int sampling = channel->sampling > 1 ? channel->sampling : 1;
    uint8_t *plane = malloc((size_t)block->width * block->height * 4), *next = plane;
    for (int y = block->y; y < block->y + block->height; y++) {
        for (int x = block->x; x < block->x + block->width; x++) {
            float value = exr_fixture_value(index, x, y);
            if (x % sampling == 0 && y % sampling == 0)
                next += store(next, channel->type, block->level == 0 ? value : -value);
        }
    }
    return plane;
}

/// See the same in engine/image/exr/encode.c.
static exr_result_t compress(exr_encode_pipeline_t *pipeline) {
    exr_result_t (**library)(exr_encode_pipeline_t *) = pipeline->encoding_user_data;
    exr_result_t code = (*library)(pipeline);
    if (pipeline->compressed_bytes == pipeline->packed_bytes)
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    return code;
}

static void write_block(exr_context_t context, int part_index, const exr_fixture_part *part,
                        const exr_chunk_info_t *chunk, const block *block) {
    exr_encode_pipeline_t pipeline;
    uint8_t *planes[8];
    must(exr_encoding_initialize(context, part_index, chunk, &pipeline));
    for (int index = 0; index < part->channel_count; index++) {
        const exr_fixture_channel *channel = &part->channels[index];
        exr_coding_channel_info_t *target = &pipeline.channels[index];
        int size = channel->type == EXR_PIXEL_HALF ? 2 : 4;
        int sampling = channel->sampling > 1 ? channel->sampling : 1;
        planes[index] = fill_plane(channel, index, block);
        target->user_bytes_per_element = (int16_t)size;
        target->user_data_type = (uint16_t)channel->type;
        target->user_pixel_stride = size;
        target->user_line_stride = size * (block->width / sampling);
        target->encode_from_ptr = planes[index];
    }
    must(exr_encoding_choose_default_routines(context, part_index, &pipeline));
    exr_result_t (*library)(exr_encode_pipeline_t *) = pipeline.compress_fn;
    if (library != NULL)
        pipeline.compress_fn = compress;
    pipeline.encoding_user_data = &library;
    must(exr_encoding_run(context, part_index, &pipeline));
    must(exr_encoding_destroy(context, &pipeline));
    for (int index = 0; index < part->channel_count; index++)
        free(planes[index]);
}

static void write_scanlines(exr_context_t context, int part_index, const exr_fixture_part *part) {
    const exr_attr_box2i_t *window = &part->data_window;
    for (int y = window->min.y; y <= window->max.y;) {
        exr_chunk_info_t chunk;
        must(exr_write_scanline_chunk_info(context, part_index, y, &chunk));
        block block = {window->min.x, y, chunk.width, chunk.height, 0};
        write_block(context, part_index, part, &chunk, &block);
        y += chunk.height;
    }
}

/// See the same in engine/image/exr/encode.c.
static void cut_tile(exr_chunk_info_t *chunk, int width, int height) {
    uint64_t texel = chunk->unpacked_size / ((uint64_t)chunk->width * (uint64_t)chunk->height);
    chunk->width = chunk->width < width ? chunk->width : width;
    chunk->height = chunk->height < height ? chunk->height : height;
    chunk->unpacked_size = texel * (uint64_t)chunk->width * (uint64_t)chunk->height;
}

static void write_level(exr_context_t context, int part_index, const exr_fixture_part *part,
                        int level) {
    int32_t width, height;
    must(exr_get_level_sizes(context, part_index, level, level, &width, &height));
    for (int row = 0; row * part->tile_height < height; row++) {
        for (int column = 0; column * part->tile_width < width; column++) {
            exr_chunk_info_t chunk;
            must(exr_write_tile_chunk_info(context, part_index, column, row, level, level, &chunk));
            cut_tile(&chunk, width - column * part->tile_width, height - row * part->tile_height);
            block block = {part->data_window.min.x + column * part->tile_width,
                           part->data_window.min.y + row * part->tile_height, chunk.width,
                           chunk.height, level};
            write_block(context, part_index, part, &chunk, &block);
        }
    }
}

static void write_tiles(exr_context_t context, int part_index, const exr_fixture_part *part) {
    int32_t levels, levels_y;
    must(exr_get_tile_levels(context, part_index, &levels, &levels_y));
    for (int level = 0; level < levels; level++)
        write_level(context, part_index, part, level);
}

static void declare_part(exr_context_t context, const exr_fixture_part *part) {
    int index;
    bool tiled = part->tile_width > 0;
    exr_attr_v2f_t centre = {.x = 0.0f, .y = 0.0f};
    must(exr_add_part(context, part->name, tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE,
                      &index));
    must(exr_initialize_required_attr(context, index, &part->display_window, &part->data_window,
                                      1.0f, &centre, 1.0f, EXR_LINEORDER_INCREASING_Y,
                                      part->compression));
    for (int channel = 0; channel < part->channel_count; channel++) {
        const exr_fixture_channel *source = &part->channels[channel];
        int sampling = source->sampling > 1 ? source->sampling : 1;
        must(exr_add_channel(context, index, source->name, source->type,
                             EXR_PERCEPTUALLY_LOGARITHMIC, sampling, sampling));
    }
    if (tiled)
        must(exr_set_tile_descriptor(
            context, index, (uint32_t)part->tile_width, (uint32_t)part->tile_height,
            part->mipmap ? EXR_TILE_MIPMAP_LEVELS : EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN));
}

void exr_fixture_write(const char *path, const exr_fixture_part *parts, int count) {
    exr_context_t context;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    must(exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &settings));
    for (int index = 0; index < count; index++)
        declare_part(context, &parts[index]);
    must(exr_write_header(context));
    for (int index = 0; index < count; index++) {
        if (parts[index].tile_width > 0)
            write_tiles(context, index, &parts[index]);
        else
            write_scanlines(context, index, &parts[index]);
    }
    must(exr_finish(&context));
}
