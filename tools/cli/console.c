#include "tools/cli/console.h"

#include <stdio.h>

static const char *level_name(lobe_log_level level) {
    switch (level) {
    case LOBE_LOG_ERROR:
        return "error: ";
    case LOBE_LOG_WARNING:
        return "warning: ";
    case LOBE_LOG_NOTICE:
        return "";
    default:
        return "debug: ";
    }
}

static void write_line(void *user, lobe_log_level level, const char *message) {
    (void)user;
    fprintf(stderr, "lobe: %s%s\n", level_name(level), message);
}

static void write_line_but_debug(void *user, lobe_log_level level, const char *message) {
    if (level != LOBE_LOG_DEBUG)
        write_line(user, level, message);
}

lobe_host console_host(bool verbose) {
    return (lobe_host){.write = verbose ? write_line : write_line_but_debug};
}
