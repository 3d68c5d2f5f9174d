#ifndef TOOLS_PROGRESS_H
#define TOOLS_PROGRESS_H

#include <stdbool.h>

/// Says on standard error what goes on. On a terminal it is one line that is written over and
/// wiped in the end; elsewhere each step is a line of its own where `lines` is set, or nothing.
typedef struct progress {
    bool terminal, lines;
    char step[160];
    double shown; ///< part last shown
} progress;

progress progress_begin(bool lines);

/// A new step.
void progress_step(progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// The part of the step that is done, [0, 1]. As lobe_render_parameters.progress has it: `user` is
/// the progress, the result is true.
bool progress_part(void *user, double part);

/// Wipes the line, so that others may write.
void progress_end(progress *progress);

#endif
