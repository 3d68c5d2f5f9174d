#ifndef ENGINE_IMAGE_EXR_INPUT_H
#define ENGINE_IMAGE_EXR_INPUT_H

#include <openexr.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// An OpenEXR file in memory, open for reading. The structure must not be moved while it is open.
typedef struct exr_input {
    const char *path;
    const lobe_host *host;
    const uint8_t *data;
    size_t size;
    uint8_t *read; ///< the same if it was read from the file system; owned
    exr_context_t context;
    char message[200]; ///< OpenEXRCore's first error message, usually the most precise one
} exr_input;

/// Where a file comes from.
typedef struct exr_origin {
    const char *path; ///< only a name for messages if `data` is given
    const void *data; ///< the whole file, not owned; NULL: it is read from the file system
    size_t size;      ///< bytes of `data`
} exr_origin;

/// Overwrites `input`. Call engine_exr_close even after a failure.
lobe_result engine_exr_open(const exr_origin *origin, const lobe_host *host, exr_input *input);
void engine_exr_close(exr_input *input);

/// Logs why OpenEXRCore failed.
lobe_result engine_exr_fail(exr_input *input, exr_result_t code);
lobe_result engine_exr_fail_damaged(const exr_input *input, const char *cause);

#endif
