#include "engine/image/exr/input.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <lobe/file.h>

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

static void store_error(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)code;
    void *user = NULL;
    if (context == NULL || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS)
        return;
    exr_input *input = user;
    if (input->message[0] == '\0')
        snprintf(input->message, sizeof input->message, "%s", message);
}

/// Messages quote bytes of the file; the log gets printable ASCII only.
static void make_printable(char *text) {
    for (; *text != '\0'; text++) {
        if (*text < ' ' || *text > '~')
            *text = '?';
    }
}

/// OpenEXRCore's decoders also report "out of memory" if a block ends too early.
static bool is_out_of_memory(exr_result_t code, const char *message) {
    return code == EXR_ERR_OUT_OF_MEMORY && strstr(message, "allocate") != NULL;
}

lobe_result engine_exr_fail(exr_input *input, exr_result_t code) {
    make_printable(input->message);
    const char *message =
        input->message[0] != '\0' ? input->message : exr_get_default_error_message(code);
    if (is_out_of_memory(code, message))
        return lobe_host_fail(input->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "%s: out of memory decoding it", input->path);
    bool unsupported = code == EXR_ERR_FEATURE_NOT_IMPLEMENTED;
    return lobe_host_fail(input->host, unsupported ? LOBE_ERROR_UNSUPPORTED : LOBE_ERROR_MALFORMED,
                          "%s: %s OpenEXR file: %s", input->path,
                          unsupported ? "unsupported" : "damaged", message);
}

lobe_result engine_exr_fail_damaged(const exr_input *input, const char *cause) {
    return lobe_host_fail(input->host, LOBE_ERROR_MALFORMED, "%s: damaged OpenEXR file: %s",
                          input->path, cause);
}

static lobe_result open_context(exr_input *input) {
    static const uint8_t magic[4] = {0x76, 0x2f, 0x31, 0x01};
    if (input->size < 4 || memcmp(input->data, magic, 4) != 0)
        return lobe_host_fail(input->host, LOBE_ERROR_MALFORMED, "%s: not an OpenEXR file",
                              input->path);
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = store_error;
    settings.user_data = input;
    settings.read_fn = read_input;
    settings.size_fn = input_size;
    // A file without its table of blocks was truncated while it was written: report that instead of
    // reconstructing the table.
    settings.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    exr_result_t code = exr_start_read(&input->context, input->path, &settings);
    return code == EXR_ERR_SUCCESS ? LOBE_OK : engine_exr_fail(input, code);
}

lobe_result engine_exr_open(const exr_origin *origin, const lobe_host *host, exr_input *input) {
    *input =
        (exr_input){.path = origin->path, .host = host, .data = origin->data, .size = origin->size};
    if (origin->data)
        return open_context(input);
    lobe_result result = lobe_file_read(origin->path, NULL, host, &input->read, &input->size);
    input->data = input->read;
    return result == LOBE_OK ? open_context(input) : result;
}

void engine_exr_close(exr_input *input) {
    if (input->context != NULL)
        exr_finish(&input->context);
    lobe_release(input->read);
    *input = (exr_input){0};
}
