#ifndef PASSES_CONTEXT_SAVING_LOG_H
#define PASSES_CONTEXT_SAVING_LOG_H

#include <lobe/host.h>

/// For what a host can do without: a failure to save it is a warning that says why.
typedef struct saving_log {
    const lobe_host *host; ///< that is warned, may be NULL
    const char *what;      ///< is saved: "filtered environment"
} saving_log;

/// A host for calls that save it. `log` must outlive these.
lobe_host passes_saving_host(saving_log *log);

#endif
