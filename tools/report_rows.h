#ifndef TOOLS_REPORT_ROWS_H
#define TOOLS_REPORT_ROWS_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/sweep_results.h"

/// Finding one's way among the rows of a sweep.

size_t report_count_rows(const sweep_results *results, const char *scene);

/// Whether it is the supersampling filter, whose time and error lie so far from those of all others
/// that plots leave it out: their captions name it.
bool report_is_far(const char *filter);

/// The value of the knob that a row varies; NULL in a row of the defaults.
const char *report_varied_value(const sweep_row *row);

#endif
