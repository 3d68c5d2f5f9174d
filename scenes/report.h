#ifndef SCENES_REPORT_H
#define SCENES_REPORT_H

#include <lobe/log.h>
#include <lobe/result.h>

/// One line to the log, formatted as by printf; control characters, which may come from names in
/// a file, are shown as '?'. `log` may be NULL.
void scene_report(const lobe_log *log, lobe_log_level level, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// Logs an error and returns `result`, so that a failing function can return in one line.
lobe_result scene_report_error(const lobe_log *log, lobe_result result, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
