#ifndef TOOLS_CLI_PROGRESS_H
#define TOOLS_CLI_PROGRESS_H

#include <stdbool.h>
#include <time.h>

/// Shows progress on standard error. On a terminal it is one line that is overwritten, and erased
/// at the end; elsewhere each step is a separate line if `lines` is set, or nothing.
typedef struct progress {
    bool terminal, lines;
    char step[160];
    double shown; ///< fraction last shown
    // Work: the expected total (0: unknown), done in previous steps, of the current step.
    double expected, done, weight;
    struct timespec start; ///< of the work
} progress;

progress progress_begin(bool lines);

/// Begins a new step.
void progress_step(progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// The total work of the steps from here on, above 0, in any unit. From then on the remaining time
/// is shown if it can be estimated.
void progress_expect(progress *progress, double work);

/// Subtracts work that turned out to be unnecessary.
void progress_spare(progress *progress, double work);

/// The work of the step that has just begun.
void progress_weigh(progress *progress, double work);

/// The fraction of the step that is done, [0, 1]. Suitable for lobe_render_parameters: `user` is
/// the progress, the result is true.
bool progress_part(void *user, double part);

/// Erases the line, for other output.
void progress_end(progress *progress);

#endif
