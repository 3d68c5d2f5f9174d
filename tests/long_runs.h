/// Cases that take seconds and find little that shorter ones do not: `tools/test --long` runs them.
#ifndef TESTS_LONG_RUNS_H
#define TESTS_LONG_RUNS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

/// Whether this is a long run.
static inline bool long_runs(void) {
    return getenv("LOBE_LONG_RUNS") != NULL;
}

/// First in a case: leaves it out of short runs.
static inline void only_in_long_runs(void) {
    if (!long_runs())
        skip();
}

#endif
