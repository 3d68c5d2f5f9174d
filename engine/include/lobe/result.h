#ifndef LOBE_RESULT_H
#define LOBE_RESULT_H

#include <lobe/api.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Result of a call. Every function that can fail returns one of these. The function that detects
/// an error logs it, once, as one readable line (see lobe/host.h). NULL for an argument that is not
/// said to allow it gives LOBE_ERROR_INVALID_ARGUMENT; functions without a result do nothing then.
typedef enum lobe_result {
    LOBE_OK = 0,
    LOBE_ERROR_INVALID_ARGUMENT,     ///< a parameter is out of its documented range
    LOBE_ERROR_NOT_FOUND,            ///< a file, scene, filter or knob of that name does not exist
    LOBE_ERROR_READ,                 ///< a file exists but cannot be read
    LOBE_ERROR_WRITE,                ///< an output cannot be written; nothing is left behind
    LOBE_ERROR_MALFORMED,            ///< a file's or a scene's content violates its format
    LOBE_ERROR_UNSUPPORTED,          ///< valid, but lobe or the device does not support it
    LOBE_ERROR_LIMIT,                ///< above a stated limit of lobe or of the device
    LOBE_ERROR_OUT_OF_MEMORY,        ///< out of host memory
    LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ///< out of device memory
    LOBE_ERROR_NO_DEVICE,            ///< no Vulkan device meets the requirements
    LOBE_ERROR_DEVICE_LOST,          ///< the device stopped responding
    LOBE_ERROR_GRAPH,                ///< a render graph is declared incorrectly
    LOBE_ERROR_SHADER,               ///< a shader is missing or does not fit its use
    LOBE_RESULT_COUNT
} lobe_result;

/// The enumerator's name, for example "LOBE_ERROR_NOT_FOUND". Never NULL; static storage.
LOBE_API const char *lobe_result_name(lobe_result result);

/// A short readable phrase, for example "not found". Never NULL; static storage.
LOBE_API const char *lobe_result_message(lobe_result result);

#ifdef __cplusplus
}
#endif

#endif
