#ifndef TOOLS_REPORT_REPORT_ROWS_H
#define TOOLS_REPORT_REPORT_ROWS_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/sweep/results.h"

/// Finding one's way among the rows of a sweep.

size_t report_count_rows(const sweep_results *results, const char *scene);

/// Whether it is the supersampling filter, whose time and error lie so far from those of all others
/// that plots leave it out: their captions name it.
bool report_is_far(const char *filter);

/// The value of the knob that a row varies; NULL in a row of the defaults.
const char *report_varied_value(const sweep_row *row);

/// Methods of integrating an environment that a sweep goes through, as the knob `env` calls them.
#define REPORT_METHODS 3
extern const char *const report_methods[REPORT_METHODS];

/// A row's method as an index; 0 where it has none.
size_t report_method(const sweep_row *row);

#endif
