#ifndef TOOLS_REPORT_SCRIPT_H
#define TOOLS_REPORT_SCRIPT_H

#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

#include <lobe/host.h>
#include <lobe/result.h>

/// The Python script lobe-report as a process. It reads pictures from standard input and, once it
/// has read all, writes the page to standard output. It reports errors itself, in one line on
/// standard error.

#define REPORT_SCRIPT_ARGUMENTS 6

typedef struct report_script {
    pid_t process;
    FILE *input, *output; ///< of the script
    void (*old_handler)(int);
} report_script;

/// Starts the script that belongs to this program: in `report` beside it in a build tree, or where
/// it was installed. `arguments` is NULL-terminated. Until report_script_finish, SIGPIPE is
/// ignored. Errors: LOBE_ERROR_NOT_FOUND (no script, or no usable Python).
lobe_result report_script_start(const char *const arguments[], const lobe_host *host,
                                report_script *script);

/// Closes the script's input, reads its output and waits for it to exit. The caller frees `*text`
/// with free(); it is NULL on failure. Errors: LOBE_ERROR_READ (the script failed),
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result report_script_finish(report_script *script, const lobe_host *host, char **text,
                                 size_t *size);

#endif
