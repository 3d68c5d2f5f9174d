#ifndef LOBE_FILE_H
#define LOBE_FILE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Whole files in memory. All that lobe reads and writes goes through here, so that nothing is
/// waited for, and a failure leaves neither half a file nor a damaged old one.

/// Largest file that is read, in bytes: 2 GiB.
#define LOBE_FILE_MAXIMUM_SIZE ((size_t)1 << 31)

/// Reads a regular file to its end. `*data` is for the caller to lobe_release; a zero byte that
/// `*size` does not count follows the content. On failure `*data` is NULL.
/// `owner`: the file that refers to this one, named in the log line too; NULL: none.
/// Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ (no permission, not a regular file),
/// LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result lobe_file_read(const char *path, const char *owner, const lobe_host *host,
                           uint8_t **data, size_t *size);

/// Where a host keeps files that are not in the file system: in memory, or in an archive.
typedef struct lobe_file_source {
    /// Gives the whole content of a file, which must stay until `release`. `path` is as the file
    /// that refers to it says, put behind that one's folder; "a/../b" stays as it is. On failure
    /// the code says why, usually LOBE_ERROR_NOT_FOUND or _READ; lobe logs it.
    lobe_result (*read)(void *user, const char *path, const void **data, size_t *size);
    /// The content is not needed any more; once for each that was given. NULL: nothing is to do.
    void (*release)(void *user, const void *data, size_t size);
    void *user; ///< handed to both
} lobe_file_source;

/// Writes a file under a temporary name in the same folder, then gives it its name, replacing an
/// old one. What is not a regular file (a device, a pipe) is written to directly.
/// Errors: LOBE_ERROR_WRITE, LOBE_ERROR_OUT_OF_MEMORY; nothing new is left behind.
lobe_result lobe_file_write(const char *path, const void *data, size_t size, const lobe_host *host);

#ifdef __cplusplus
}
#endif

#endif
