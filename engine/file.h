#ifndef ENGINE_FILE_H
#define ENGINE_FILE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/log.h>
#include <lobe/result.h>

/// Whole files in memory. Every output goes through engine_file_write, so that a failure leaves
/// neither half a file nor a damaged old one.

/// Largest file that is read, in bytes.
#define ENGINE_FILE_MAXIMUM_SIZE ((size_t)1 << 32)

/// Reads a regular file or a pipe to its end. `*data` is to free() by the caller; it is not NULL
/// even where the file is empty. On failure `*data` is NULL.
/// Errors: LOBE_ERROR_NOT_FOUND, LOBE_ERROR_READ, LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result engine_file_read(const char *path, const lobe_log *log, uint8_t **data, size_t *size);

/// Writes a file under a temporary name in the same folder, then gives it its name, replacing an
/// old one. What is not a regular file (a device, a pipe) is written to directly.
/// Errors: LOBE_ERROR_WRITE; nothing new is left behind.
lobe_result engine_file_write(const char *path, const void *data, size_t size, const lobe_log *log);

#endif
