#ifndef LOBE_RESULT_H
#define LOBE_RESULT_H

#ifdef __cplusplus
extern "C" {
#endif

/// What a call of the library came to. Every function that can fail returns one of these; the
/// one-line explanation for people goes to the log (see lobe/host.h), once, from the function
/// that found the fault.
typedef enum lobe_result {
    LOBE_OK = 0,
    LOBE_ERROR_INVALID_ARGUMENT,     ///< a parameter is out of its documented range
    LOBE_ERROR_NOT_FOUND,            ///< a file, scene, filter or knob of that name does not exist
    LOBE_ERROR_READ,                 ///< a file exists but cannot be read
    LOBE_ERROR_WRITE,                ///< an output cannot be written; nothing is left behind
    LOBE_ERROR_MALFORMED,            ///< a file's content breaks its format
    LOBE_ERROR_UNSUPPORTED,          ///< valid, but lobe or the device cannot do it
    LOBE_ERROR_LIMIT,                ///< larger than a stated limit of lobe or of the device
    LOBE_ERROR_OUT_OF_MEMORY,        ///< host memory
    LOBE_ERROR_OUT_OF_DEVICE_MEMORY, ///< device memory
    LOBE_ERROR_NO_DEVICE,            ///< no Vulkan device that meets the requirements
    LOBE_ERROR_DEVICE_LOST,          ///< the device stopped answering
    LOBE_ERROR_GRAPH,                ///< a render graph was declared wrongly
    LOBE_ERROR_SHADER,               ///< a shader is missing or does not fit its use
    LOBE_RESULT_COUNT
} lobe_result;

/// The enumerator's name, for example "LOBE_ERROR_NOT_FOUND". Never NULL; static storage.
const char *lobe_result_name(lobe_result result);

/// A short phrase for people, for example "not found". Never NULL; static storage.
const char *lobe_result_message(lobe_result result);

#ifdef __cplusplus
}
#endif

#endif
