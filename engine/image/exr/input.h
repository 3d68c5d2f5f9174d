#ifndef ENGINE_IMAGE_EXR_INPUT_H
#define ENGINE_IMAGE_EXR_INPUT_H

#include <openexr.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// An OpenEXR file in memory, open for reading. It must not be moved while it is open.
typedef struct exr_input {
    const char *path;
    const lobe_host *host;
    const uint8_t *data;
    size_t size;
    uint8_t *read; ///< the same, where it was read from the file system; owned
    exr_context_t context;
    char message[200]; ///< the first thing OpenEXRCore complained about, usually the most precise
} exr_input;

/// Where a file comes from.
typedef struct exr_origin {
    const char *path; ///< or its name alone, where `data` is given
    const void *data; ///< the whole of it, not owned; NULL: it is read from the file system
    size_t size;      ///< bytes of `data`
} exr_origin;

/// Overwrites `input`; engine_exr_close it in all cases.
lobe_result engine_exr_open(const exr_origin *origin, const lobe_host *host, exr_input *input);
void engine_exr_close(exr_input *input);

/// Logs what OpenEXRCore found fault with.
lobe_result engine_exr_fail(exr_input *input, exr_result_t code);
lobe_result engine_exr_fail_damaged(const exr_input *input, const char *cause);

#endif
