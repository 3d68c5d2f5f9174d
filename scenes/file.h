#ifndef SCENES_FILE_H
#define SCENES_FILE_H

#include <stddef.h>

#include <lobe/log.h>
#include <lobe/result.h>

/// Largest file that is read, in bytes.
#define SCENE_FILE_MAXIMUM_SIZE ((size_t)1 << 31)

/// Reads all of a regular file; the caller frees `*bytes` (one zero byte follows the content).
/// `owner`: the file that refers to this one, named in messages too; NULL: none.
/// Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ (no permission, no regular file),
/// LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scene_read_file(const char *path, const char *owner, const lobe_log *log, void **bytes,
                            size_t *size);

#endif
