#ifndef TOOLS_CLI_OUTPUT_FILE_H
#define TOOLS_CLI_OUTPUT_FILE_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// Whether the name has this ending (".png"), in upper or lower case.
bool output_file_has_ending(const char *path, const char *ending);

/// Checks, before minutes of work, that a file can be written: its folder must exist and be
/// writable, and the name must not be a folder. Leaves nothing behind. A NULL path is allowed.
/// Errors: LOBE_ERROR_WRITE, with a message.
lobe_result output_file_check(const char *path, const lobe_host *host);

/// Writes a text file, completely or not at all. Errors: LOBE_ERROR_WRITE, with a message.
lobe_result output_file_write(const char *path, const char *text, const lobe_host *host);

#endif
