#ifndef TOOLS_CHOICE_BUDGET_OPTIONS_H
#define TOOLS_CHOICE_BUDGET_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "tools/cli/options.h"

/// The options that choose filter and knobs by measurements.
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

/// The option that asks for a choice by measurements, "--budget" or "--error"; NULL if neither is
/// given.
const char *budget_options_limit(const budget_options *options);

/// Checks for options that exclude each other. `fixed` is an option by which the user chose filter
/// or knobs, like "--set"; NULL if there is none. Returns 0, or the exit status after a message on
/// standard error.
int budget_options_check(const option_table *table, const budget_options *options,
                         const char *fixed);

#endif
