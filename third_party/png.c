#include "third_party/image_codec.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <png.h>

typedef struct png_job {
    png_structp png;
    png_infop info;
    library_memory *memory;
    const uint8_t *bytes;
    size_t size, position;
    image_codec_extent extent;
    bool sixteen_bits; // wanted
    png_bytep *rows;
    uint8_t *rgba;
    char *message;
} png_job;

static void on_error(png_structp png, png_const_charp text) {
    png_job *job = png_get_error_ptr(png);
    snprintf(job->message, IMAGE_CODEC_MESSAGE_SIZE, "broken PNG: %s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) {
    (void)png;
    (void)text;
}

static void on_read(png_structp png, png_bytep out, size_t size) {
    png_job *job = png_get_io_ptr(png);
    if (size > job->size - job->position)
        png_error(png, "ends early");
    memcpy(out, job->bytes + job->position, size);
    job->position += size;
}

static png_voidp on_allocate(png_structp png, png_alloc_size_t size) {
    return library_memory_resize(png_get_mem_ptr(png), NULL, size);
}

static void on_release(png_structp png, png_voidp piece) {
    ((const library_memory *)png_get_mem_ptr(png))->release(piece);
}

static bool open_job(png_job *job) {
    snprintf(job->message, IMAGE_CODEC_MESSAGE_SIZE, "out of memory");
    job->png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, job, on_error, on_warning,
                                        job->memory, on_allocate, on_release);
    if (!job->png)
        return false;
    job->info = png_create_info_struct(job->png);
    png_set_read_fn(job->png, job, on_read);
    // The caller judges the extent; text and profiles are not worth their memory.
    png_set_user_limits(job->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_chunk_malloc_max(job->png, 1 << 23);
    return job->info != NULL;
}

static void close_job(png_job *job) {
    png_destroy_read_struct(&job->png, &job->info, NULL);
    job->memory->release(job->rows);
}

// libpng reports errors with a longjmp to here, so `step` must own nothing.
static bool run(png_job *job, void (*step)(png_job *job)) {
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    step(job);
    return true;
}

static void read_header(png_job *job) {
    png_read_info(job->png, job->info);
    job->extent.width = png_get_image_width(job->png, job->info);
    job->extent.height = png_get_image_height(job->png, job->info);
    job->extent.sixteen_bits = png_get_bit_depth(job->png, job->info) == 16;
}

static void ask_for_rgba(png_job *job) {
    png_set_expand(job->png);
    png_set_gray_to_rgb(job->png);
    png_set_add_alpha(job->png, 0xffff, PNG_FILLER_AFTER);
    if (!job->sixteen_bits)
        png_set_scale_16(job->png);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    else
        png_set_swap(job->png);
#endif
    png_set_interlace_handling(job->png);
    png_read_update_info(job->png, job->info);
}

static void read_texels(png_job *job) {
    ask_for_rgba(job);
    size_t row_size = (size_t)job->extent.width * (job->sixteen_bits ? 8 : 4);
    if (png_get_rowbytes(job->png, job->info) != row_size)
        png_error(job->png, "unexpected size of a row");
    for (uint32_t y = 0; y < job->extent.height; y++)
        job->rows[y] = job->rgba + y * row_size;
    png_read_image(job->png, job->rows);
    png_read_end(job->png, NULL);
}

bool third_party_png_measure(const void *bytes, size_t size, library_memory *memory,
                             image_codec_extent *extent, char message[IMAGE_CODEC_MESSAGE_SIZE]) {
    png_job job = {.memory = memory, .bytes = bytes, .size = size, .message = message};
    bool done = open_job(&job) && run(&job, read_header);
    *extent = job.extent;
    close_job(&job);
    return done;
}

bool third_party_png_decode(const void *bytes, size_t size, library_memory *memory,
                            const image_codec_extent *extent, bool sixteen_bits, void *rgba,
                            char message[IMAGE_CODEC_MESSAGE_SIZE]) {
    png_job job = {
        .memory = memory, .bytes = bytes, .size = size, .message = message, .rgba = rgba};
    job.sixteen_bits = sixteen_bits && extent->sixteen_bits;
    bool done = open_job(&job);
    if (done)
        job.rows = library_memory_resize(memory, NULL, extent->height * sizeof *job.rows);
    done = done && job.rows && run(&job, read_header) && run(&job, read_texels);
    close_job(&job);
    return done;
}
