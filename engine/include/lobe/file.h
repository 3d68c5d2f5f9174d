#ifndef LOBE_FILE_H
#define LOBE_FILE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Reading and writing whole files. All files that lobe reads and writes go through here: reading
/// never blocks on a pipe or terminal, and a failed write leaves neither half a file nor a damaged
/// old one.

/// Largest file that is read, in bytes: 2 GiB.
#define LOBE_FILE_MAXIMUM_SIZE ((size_t)1 << 31)

/// Reads a regular file to its end. The caller frees `*data` with lobe_release; a zero byte, not
/// counted in `*size`, follows the content. On failure `*data` is NULL.
/// `owner`: the file that refers to this one, also named in error messages; NULL: none.
/// Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ (no permission, not a regular file),
/// LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_file_read(const char *path, const char *owner, const lobe_host *host,
                                    uint8_t **data, size_t *size);

/// Files of a host that are not in the file system but in memory or in an archive.
typedef struct lobe_file_source {
    /// Returns the whole content of a file, which must stay valid until `release`. `path` is the
    /// folder of the referring file followed by the path given there; "a/../b" is not simplified.
    /// On failure return the reason, usually LOBE_ERROR_NOT_FOUND or _READ; lobe logs it.
    lobe_result (*read)(void *user, const char *path, const void **data, size_t *size);
    /// Called once for each content returned, when lobe no longer needs it. NULL: not called.
    void (*release)(void *user, const void *data, size_t size);
    void *user; ///< passed to both
} lobe_file_source;

/// Writes a file under a temporary name in the same folder, then renames it, replacing an old file.
/// On file systems that can, it has no name until it is complete, so that a killed program leaves
/// nothing half-written. Anything but a regular file (a device, a pipe) is written to directly.
/// Errors: LOBE_ERROR_WRITE, LOBE_ERROR_OUT_OF_MEMORY; the temporary file is removed then.
LOBE_API lobe_result lobe_file_write(const char *path, const void *data, size_t size,
                                     const lobe_host *host);

#ifdef __cplusplus
}
#endif

#endif
