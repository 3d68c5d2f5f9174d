#include <lobe/result.h>

#include <stddef.h>

typedef struct result_text {
    const char *name, *message;
} result_text;

#define RESULT(code, message) [code] = {#code, message}

static const result_text texts[LOBE_RESULT_COUNT] = {
    RESULT(LOBE_OK, "success"),
    RESULT(LOBE_ERROR_INVALID_ARGUMENT, "invalid argument"),
    RESULT(LOBE_ERROR_NOT_FOUND, "not found"),
    RESULT(LOBE_ERROR_READ, "cannot be read"),
    RESULT(LOBE_ERROR_WRITE, "cannot be written"),
    RESULT(LOBE_ERROR_MALFORMED, "malformed content"),
    RESULT(LOBE_ERROR_UNSUPPORTED, "not supported"),
    RESULT(LOBE_ERROR_LIMIT, "above a limit"),
    RESULT(LOBE_ERROR_OUT_OF_MEMORY, "out of memory"),
    RESULT(LOBE_ERROR_OUT_OF_DEVICE_MEMORY, "out of device memory"),
    RESULT(LOBE_ERROR_NO_DEVICE, "no suitable Vulkan device"),
    RESULT(LOBE_ERROR_DEVICE_LOST, "the device was lost"),
    RESULT(LOBE_ERROR_GRAPH, "invalid render graph"),
    RESULT(LOBE_ERROR_SHADER, "invalid shader"),
};

static const result_text *text_of(lobe_result result) {
    static const result_text unknown = {"unknown lobe_result", "unknown result"};
    return (unsigned)result < LOBE_RESULT_COUNT ? &texts[result] : &unknown;
}

const char *lobe_result_name(lobe_result result) {
    return text_of(result)->name;
}

const char *lobe_result_message(lobe_result result) {
    return text_of(result)->message;
}
