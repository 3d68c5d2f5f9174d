#include <lobe/host.h>

#include <stdarg.h>
#include <stdio.h>

const lobe_allocator *lobe_host_allocator(const lobe_host *host) {
    return host ? host->allocator : NULL;
}

static void write_line(const lobe_host *host, lobe_log_level level, const char *format,
                       va_list arguments) {
    if (!host || !host->write)
        return;
    char line[1024];
    vsnprintf(line, sizeof line, format, arguments);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    host->write(host->user, level, line);
}

void lobe_host_log(const lobe_host *host, lobe_log_level level, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_line(host, level, format, arguments);
    va_end(arguments);
}

lobe_result lobe_host_fail(const lobe_host *host, lobe_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_line(host, LOBE_LOG_ERROR, format, arguments);
    va_end(arguments);
    return result;
}
