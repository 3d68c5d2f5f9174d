#ifndef ENGINE_BASE_HOST_CLOCK_H
#define ENGINE_BASE_HOST_CLOCK_H

#include <time.h>

/// CPU time of the calling thread, in milliseconds from some moment on: waiting does not count, nor
/// do other programs.
static inline double engine_host_milliseconds(void) {
    struct timespec time = {0};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

#endif
