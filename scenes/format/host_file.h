#ifndef SCENES_FORMAT_HOST_FILE_H
#define SCENES_FORMAT_HOST_FILE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/file.h>

/// Reads a file from the host's file source, or from the file system if `files` is NULL. Otherwise
/// as lobe_file_read.
lobe_result scenes_host_file_read(const lobe_file_source *files, const char *path,
                                  const char *owner, const lobe_host *host, uint8_t **data,
                                  size_t *size);

/// Copies a file's content in memory, with a result as from lobe_file_read.
lobe_result scenes_host_file_copy(const char *path, const void *content, size_t content_size,
                                  const lobe_host *host, uint8_t **data, size_t *size);

#endif
