#include "passes/context/saving_log.h"

static void warn(void *user, lobe_log_level level, const char *message) {
    const saving_log *log = user;
    if (level == LOBE_LOG_ERROR)
        lobe_host_log(log->host, LOBE_LOG_WARNING, "cannot save the %s: %s", log->what, message);
}

lobe_host passes_saving_host(saving_log *log) {
    return (lobe_host){.write = warn, .allocator = lobe_host_allocator(log->host), .user = log};
}
