#ifndef PASSES_FILTERS_SETTINGS_H
#define PASSES_FILTERS_SETTINGS_H

#include <lobe/filter.h>

/// Every value is one that its knob allows; else one line and LOBE_ERROR_INVALID_ARGUMENT.
lobe_result passes_settings_check(const lobe_filter *filter, const lobe_settings *settings,
                                  const lobe_host *host);

#endif
