#ifndef TOOLS_CHOICE_BUDGET_OPTIONS_H
#define TOOLS_CHOICE_BUDGET_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "tools/cli/options.h"

/// The options that leave the choice of filter and knobs to what was measured.
typedef struct budget_options {
    double milliseconds, error;
    const char *sweep; ///< NULL: calibrate
    uint32_t maps;     ///< 0: rebuilt in each frame, 1: retained
    bool has_milliseconds, has_error, has_maps;
} budget_options;

/// Entries for an option table.
option budget_option_milliseconds(budget_options *options);
option budget_option_error(budget_options *options);
option budget_option_sweep(budget_options *options);
option budget_option_maps(budget_options *options);

/// Whether the choice is left to measurements: "--budget" or "--error", NULL where it is not.
const char *budget_options_limit(const budget_options *options);

/// Looks for options that do not go together. `fixed` is an option by which the user chose filter
/// or knobs, "--set"; NULL where there is none. Returns 0, or the exit status after a line on
/// standard error.
int budget_options_check(const option_table *table, const budget_options *options,
                         const char *fixed);

#endif
