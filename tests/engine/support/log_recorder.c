#include "tests/engine/support/log_recorder.h"

#include <stdio.h>
#include <string.h>

static void record(void *user, lobe_log_level level, const char *message) {
    log_recorder *recorder = user;
    if (level == LOBE_LOG_ERROR) {
        recorder->errors++;
        snprintf(recorder->last_error, sizeof recorder->last_error, "%s", message);
    } else if (level == LOBE_LOG_WARNING) {
        recorder->warnings++;
        snprintf(recorder->last_warning, sizeof recorder->last_warning, "%s", message);
    } else if (level == LOBE_LOG_NOTICE) {
        const size_t length = strlen(recorder->all_notices);
        recorder->notices++;
        snprintf(recorder->all_notices + length, sizeof recorder->all_notices - length, "%s\n",
                 message);
    }
}

void log_recorder_start(log_recorder *recorder) {
    *recorder = (log_recorder){.host = {.write = record, .user = recorder}};
}
