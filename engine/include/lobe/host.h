#ifndef LOBE_HOST_H
#define LOBE_HOST_H

#include <lobe/allocator.h>
#include <lobe/api.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lobe_log_level {
    LOBE_LOG_ERROR,   ///< why a call failed: exactly one line for each failure
    LOBE_LOG_WARNING, ///< the call went on, but not exactly as asked
    LOBE_LOG_NOTICE,  ///< a choice made for the user (a default light, a default camera)
    LOBE_LOG_DEBUG,   ///< for developers
} lobe_log_level;

/// What a host provides to lobe: a log and memory. lobe prints nothing itself. Objects that outlive
/// a call keep a copy of this structure. Where a lobe_host is expected, NULL means: no log, and the
/// C library's memory.
typedef struct lobe_host {
    /// Called with one line of UTF-8 without a line end; `message` lives only during the call.
    /// May be called from several threads at once. NULL drops all messages.
    void (*write)(void *user, lobe_log_level level, const char *message);
    /// Not copied: it must outlive everything made with this host. NULL: the C library's.
    const lobe_allocator *allocator;
    void *user; ///< passed to `write`
} lobe_host;

/// The host's allocator; NULL (the C library's) if it or `host` is NULL.
LOBE_API const lobe_allocator *lobe_host_allocator(const lobe_host *host);

/// Lets compilers that support it check the arguments against the format.
#if defined(__GNUC__)
#define LOBE_HOST_FORMAT __attribute__((format(printf, 3, 4)))
#else
#define LOBE_HOST_FORMAT
#endif

/// Formats one line as printf does (cut at 1023 bytes) and logs it. Control characters, for example
/// in names from files, are replaced by '?'. `host` may be NULL.
LOBE_API LOBE_HOST_FORMAT void lobe_host_log(const lobe_host *host, lobe_log_level level,
                                             const char *format, ...);

/// Logs the line that explains a failure, at level LOBE_LOG_ERROR, and returns `result`:
/// `return lobe_host_fail(host, LOBE_ERROR_LIMIT, "texture '%s': ...", name);`
LOBE_API LOBE_HOST_FORMAT lobe_result lobe_host_fail(const lobe_host *host, lobe_result result,
                                                     const char *format, ...);

#ifdef __cplusplus
}
#endif

#endif
