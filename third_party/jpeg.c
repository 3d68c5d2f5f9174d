#include "third_party/image_codec.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jpeglib.h>

#include <jerror.h>

// A progressive image with more scans than this is an attack on decoding time.
#define JPEG_MAXIMUM_SCANS 500

typedef struct jpeg_job {
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    struct jpeg_decompress_struct jpeg;
    jmp_buf failed;
    const void *bytes;
    size_t size;
    image_codec_extent extent;
    uint8_t *rgba;
    char *message;
} jpeg_job;

/// `kind`: what is said of the file before the cause.
static void fail(jpeg_job *job, const char *kind, const char *text) {
    snprintf(job->message, IMAGE_CODEC_MESSAGE_SIZE, "%s: %s", kind, text);
    longjmp(job->failed, 1);
}

static void on_error(j_common_ptr jpeg) {
    char text[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, text);
    fail(jpeg->client_data, "broken JPEG", text);
}

// If an image ends early, libjpeg pads it with grey and warns; other warnings are harmless.
static void on_message(j_common_ptr jpeg, int level) {
    int code = jpeg->err->msg_code;
    if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER))
        fail(jpeg->client_data, "broken JPEG", "ends early");
}

static void on_output(j_common_ptr jpeg) {
    (void)jpeg;
}

static void on_progress(j_common_ptr jpeg) {
    jpeg_job *job = jpeg->client_data;
    if (job->jpeg.input_scan_number > JPEG_MAXIMUM_SCANS)
        fail(job, "broken JPEG", "too many scans");
}

static void open_job(jpeg_job *job) {
    snprintf(job->message, IMAGE_CODEC_MESSAGE_SIZE, "out of memory");
    job->jpeg.err = jpeg_std_error(&job->errors);
    job->errors.error_exit = on_error;
    job->errors.emit_message = on_message;
    job->errors.output_message = on_output;
    job->jpeg.client_data = job;
}

static void read_header(jpeg_job *job) {
    jpeg_create_decompress(&job->jpeg);
    job->progress.progress_monitor = on_progress;
    job->jpeg.progress = &job->progress;
    jpeg_mem_src(&job->jpeg, job->bytes, job->size);
    jpeg_read_header(&job->jpeg, TRUE);
    if (job->jpeg.num_components != 1 && job->jpeg.num_components != 3)
        fail(job, "unsupported JPEG", "its colours are neither grey nor RGB");
    job->extent.width = job->jpeg.image_width;
    job->extent.height = job->jpeg.image_height;
}

static void read_texels(jpeg_job *job) {
    read_header(job);
    job->jpeg.out_color_space = JCS_EXT_RGBA;
    job->jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&job->jpeg);
    size_t row_size = (size_t)job->extent.width * 4;
    while (job->jpeg.output_scanline < job->jpeg.output_height) {
        JSAMPROW row = job->rgba + job->jpeg.output_scanline * row_size;
        jpeg_read_scanlines(&job->jpeg, &row, 1);
    }
    jpeg_finish_decompress(&job->jpeg);
}

// libjpeg reports errors with a longjmp to here, so `step` must own nothing.
static bool run(jpeg_job *job, void (*step)(jpeg_job *job)) {
    if (setjmp(job->failed))
        return false;
    step(job);
    return true;
}

bool third_party_jpeg_measure(const void *bytes, size_t size, image_codec_extent *extent,
                              char message[IMAGE_CODEC_MESSAGE_SIZE]) {
    jpeg_job job = {.bytes = bytes, .size = size, .message = message};
    open_job(&job);
    bool done = run(&job, read_header);
    *extent = job.extent;
    jpeg_destroy_decompress(&job.jpeg);
    return done;
}

bool third_party_jpeg_decode(const void *bytes, size_t size, const image_codec_extent *extent,
                             void *rgba, char message[IMAGE_CODEC_MESSAGE_SIZE]) {
    jpeg_job job = {.bytes = bytes, .size = size, .message = message, .rgba = rgba};
    job.extent = *extent;
    open_job(&job);
    bool done = run(&job, read_texels);
    jpeg_destroy_decompress(&job.jpeg);
    return done;
}
