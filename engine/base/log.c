#include <lobe/log.h>

#include <stdarg.h>
#include <stdio.h>

const lobe_allocator *lobe_log_allocator(const lobe_log *log) {
    return log ? log->allocator : NULL;
}

static void write_line(const lobe_log *log, lobe_log_level level, const char *format,
                       va_list arguments) {
    if (!log || !log->write)
        return;
    char line[1024];
    vsnprintf(line, sizeof line, format, arguments);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    log->write(log->user, level, line);
}

void lobe_log_print(const lobe_log *log, lobe_log_level level, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_line(log, level, format, arguments);
    va_end(arguments);
}

lobe_result lobe_log_fail(const lobe_log *log, lobe_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_line(log, LOBE_LOG_ERROR, format, arguments);
    va_end(arguments);
    return result;
}
