#ifndef TOOLS_CHOICE_FILTER_CHOICE_H
#define TOOLS_CHOICE_FILTER_CHOICE_H

#include <lobe/filter.h>

#include "tools/cli/options.h"

/// An entry of an option table: --set, for one filter.
option filter_option_set(option_list *assignments);

/// Finds the filter of that name, and sets the knobs that are assigned ("KNOB=VALUE"), the others
/// to their defaults. Returns 0, or the exit status after a message on standard error.
int filter_choice_make(const char *name, const option_list *assignments, const lobe_host *host,
                       const lobe_filter **filter, lobe_settings *settings);

#endif
