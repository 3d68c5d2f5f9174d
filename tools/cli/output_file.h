#ifndef TOOLS_CLI_OUTPUT_FILE_H
#define TOOLS_CLI_OUTPUT_FILE_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// Whether the name ends so (".png"), in any case.
bool output_file_has_ending(const char *path, const char *ending);

/// Finds out, before minutes of work, whether a file can be written: its folder must exist and
/// take files, the name must not be a folder's. Leaves nothing behind. A NULL path is fine.
/// Errors: LOBE_ERROR_WRITE with a line.
lobe_result output_file_check(const char *path, const lobe_host *host);

/// Writes a text file, whole or not at all. Errors: LOBE_ERROR_WRITE with a line.
lobe_result output_file_write(const char *path, const char *text, const lobe_host *host);

#endif
