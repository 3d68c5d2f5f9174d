#ifndef PASSES_FILTERS_SETTINGS_H
#define PASSES_FILTERS_SETTINGS_H

#include <lobe/filter.h>

/// Checks every value against its knob. LOBE_ERROR_INVALID_ARGUMENT with one line for the first
/// that is not allowed.
lobe_result passes_settings_check(const lobe_filter *filter, const lobe_settings *settings,
                                  const lobe_host *host);

#endif
