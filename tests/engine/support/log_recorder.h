#ifndef TESTS_ENGINE_SUPPORT_LOG_RECORDER_H
#define TESTS_ENGINE_SUPPORT_LOG_RECORDER_H

#include <lobe/host.h>

/// A log that counts its messages and keeps the last ones.
typedef struct log_recorder {
    lobe_host host; ///< pass this to lobe
    int errors, warnings, notices;
    char last_error[1024];
    char last_warning[1024];
    char all_notices[4096]; ///< each followed by a line end
} log_recorder;

/// Starts or restarts; the recorder must not be moved.
void log_recorder_start(log_recorder *recorder);

#endif
