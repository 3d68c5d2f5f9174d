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

lobe_result engine_fail(const lobe_log *log, lobe_result result, const char *format, ...) {
    char line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    lobe_log_print(log, LOBE_LOG_ERROR, "%s", line);
    return result;
}
