#ifndef LOBE_LOG_H
#define LOBE_LOG_H

#include <lobe/allocator.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lobe_log_level {
    LOBE_LOG_ERROR,   ///< why a call failed: exactly one line for each failure
    LOBE_LOG_WARNING, ///< the call went on, but not quite as asked
    LOBE_LOG_NOTICE,  ///< a choice made for the user (a default light, a default camera)
    LOBE_LOG_DEBUG,   ///< for developers
} lobe_log_level;

/// Where the library sends its words, and where it gets its memory. lobe prints nothing of its own.
typedef struct lobe_log {
    /// Called with one line of UTF-8 without a line end; `message` lives only during the call.
    /// May be called from several threads at once. NULL drops all messages.
    void (*write)(void *user, lobe_log_level level, const char *message);
    void *user; ///< handed to `write` unchanged
    /// Not copied: it must outlive all that was made with this log. NULL: the C library's.
    const lobe_allocator *allocator;
} lobe_log;

/// The log's allocator; NULL, the C library's, where it or the log is NULL.
const lobe_allocator *lobe_log_allocator(const lobe_log *log);

/// The compiler checks arguments against the format where it knows how.
#if defined(__GNUC__)
#define LOBE_LOG_FORMAT __attribute__((format(printf, 3, 4)))
#else
#define LOBE_LOG_FORMAT
#endif

/// Formats one line as printf does (cut at 1023 bytes) and sends it. Control characters, which
/// names in files may bring, are shown as '?'. `log` may be NULL.
LOBE_LOG_FORMAT void lobe_log_print(const lobe_log *log, lobe_log_level level, const char *format,
                                    ...);

/// Sends the line that explains a failure, at level LOBE_LOG_ERROR, and returns `result`:
/// `return lobe_log_fail(log, LOBE_ERROR_LIMIT, "texture '%s': ...", name);`
LOBE_LOG_FORMAT lobe_result lobe_log_fail(const lobe_log *log, lobe_result result,
                                          const char *format, ...);

#ifdef __cplusplus
}
#endif

#endif
