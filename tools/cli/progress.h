#ifndef TOOLS_CLI_PROGRESS_H
#define TOOLS_CLI_PROGRESS_H

#include <stdbool.h>
#include <time.h>

/// Says on standard error what goes on. On a terminal it is one line that is written over and
/// wiped in the end; elsewhere each step is a line of its own where `lines` is set, or nothing.
typedef struct progress {
    bool terminal, lines;
    char step[160];
    double shown; ///< part last shown
    // Work: all that is expected (0: unknown), done in former steps, of this step.
    double expected, done, weight;
    struct timespec start; ///< of the work
} progress;

progress progress_begin(bool lines);

/// A new step.
void progress_step(progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// The steps from here on are so much work together, above 0, in a unit of the caller's: from then
/// on the time left is shown, as far as it can be told from what is done.
void progress_expect(progress *progress, double work);

/// So much of the work need not be done after all.
void progress_spare(progress *progress, double work);

/// The step that has just begun is so much of it.
void progress_weigh(progress *progress, double work);

/// The part of the step that is done, [0, 1]. As lobe_render_parameters.progress has it: `user` is
/// the progress, the result is true.
bool progress_part(void *user, double part);

/// Wipes the line, so that others may write.
void progress_end(progress *progress);

#endif
