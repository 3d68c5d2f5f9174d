#include "engine/text.h"

#include <stdarg.h>
#include <stdio.h>

#define LINE_SIZE 1024

char *engine_text(const char *format, ...) {
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    return length < 0 ? NULL : text;
}

static void log_line(const lobe_log *log, lobe_log_level level, const char *format,
                     va_list arguments) {
    if (!log || !log->write)
        return;
    char line[LINE_SIZE];
    vsnprintf(line, sizeof line, format, arguments);
    log->write(log->user, level, line);
}

void engine_log(const lobe_log *log, lobe_log_level level, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    log_line(log, level, format, arguments);
    va_end(arguments);
}

lobe_result engine_fail(const lobe_log *log, lobe_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    log_line(log, LOBE_LOG_ERROR, format, arguments);
    va_end(arguments);
    return result;
}
