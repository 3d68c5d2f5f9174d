#include "tools/progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

progress progress_begin(bool lines) {
    return (progress){.terminal = isatty(STDERR_FILENO), .lines = lines};
}

// The cursor stays at the start of the line: whatever is written next replaces it.
static void show(const progress *progress, double part) {
    if (part > 0)
        fprintf(stderr, "%s: %.0f %%\033[K\r", progress->step, 100 * part);
    else
        fprintf(stderr, "%s\033[K\r", progress->step);
    fflush(stderr);
}

void progress_step(progress *progress, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(progress->step, sizeof progress->step, format, arguments);
    va_end(arguments);
    progress->shown = 0;
    if (progress->terminal)
        show(progress, 0);
    else if (progress->lines)
        fprintf(stderr, "lobe: %s\n", progress->step);
}

bool progress_part(void *user, double part) {
    progress *progress = user;
    if (progress->terminal && part >= progress->shown + 0.01) {
        progress->shown = part;
        show(progress, part);
    }
    return true;
}

void progress_end(progress *progress) {
    if (progress->terminal)
        fputs("\033[K", stderr);
}
