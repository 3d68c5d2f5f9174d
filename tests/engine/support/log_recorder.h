#ifndef TESTS_ENGINE_SUPPORT_LOG_RECORDER_H
#define TESTS_ENGINE_SUPPORT_LOG_RECORDER_H

#include <lobe/host.h>

/// A log that keeps what it is told, for tests to look at.
typedef struct log_recorder {
    lobe_host host; ///< hand this to lobe
    int errors, warnings, notices;
    char last_error[1024];
    char last_warning[1024];
} log_recorder;

/// Starts or restarts; the recorder must stay where it is.
void log_recorder_start(log_recorder *recorder);

#endif
