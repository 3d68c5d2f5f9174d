#include "tools/cli/progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

progress progress_begin(bool lines) {
    return (progress){.terminal = isatty(STDERR_FILENO), .lines = lines};
}

/// Less work than this does not allow an estimate.
#define TELLING_PART 0.01

static double seconds_since(const struct timespec *start) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

/// ", about 3 min left", or nothing.
static void describe_time_left(const progress *progress, double part, char *text, size_t size) {
    double done = progress->done + part * progress->weight;
    text[0] = '\0';
    if (progress->expected <= 0 || done < TELLING_PART * progress->expected)
        return;
    double left = progress->expected > done ? progress->expected - done : 0;
    double seconds = seconds_since(&progress->start) / done * left;
    if (seconds < 90)
        snprintf(text, size, ", about %.0f s left", seconds);
    else if (seconds < 90 * 60)
        snprintf(text, size, ", about %.0f min left", seconds / 60);
    else
        snprintf(text, size, ", about %.1f h left", seconds / 3600);
}

// The cursor stays at the start of the line: the next output replaces it.
static void show(const progress *progress, double part) {
    char left[64];
    describe_time_left(progress, part, left, sizeof left);
    if (part > 0)
        fprintf(stderr, "%s: %.0f %%%s\033[K\r", progress->step, 100 * part, left);
    else
        fprintf(stderr, "%s%s\033[K\r", progress->step, left);
    fflush(stderr);
}

void progress_step(progress *progress, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(progress->step, sizeof progress->step, format, arguments);
    va_end(arguments);
    progress->shown = 0;
    progress->done += progress->weight;
    progress->weight = 0;
    char left[64];
    describe_time_left(progress, 0, left, sizeof left);
    if (progress->terminal)
        show(progress, 0);
    else if (progress->lines)
        fprintf(stderr, "lobe: %s%s\n", progress->step, left);
}

void progress_expect(progress *progress, double work) {
    progress->expected = work;
    progress->done = progress->weight = 0;
    clock_gettime(CLOCK_MONOTONIC, &progress->start);
}

void progress_spare(progress *progress, double work) {
    progress->expected -= work;
}

void progress_weigh(progress *progress, double work) {
    progress->weight = work;
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
