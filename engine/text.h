#ifndef ENGINE_TEXT_H
#define ENGINE_TEXT_H

#include <lobe/log.h>
#include <lobe/result.h>

/// printf into fresh memory, to free() by the caller. NULL without memory.
char *engine_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// Sends the line that explains a failure, at level error, and returns `result`:
/// `return engine_fail(log, LOBE_ERROR_LIMIT, "texture '%s': ...", name);`
lobe_result engine_fail(const lobe_log *log, lobe_result result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
