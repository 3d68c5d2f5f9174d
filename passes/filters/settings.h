#ifndef PASSES_FILTERS_SETTINGS_H
#define PASSES_FILTERS_SETTINGS_H

#include <lobe/device.h>
#include <lobe/filter.h>

/// Checks every value against its knob. LOBE_ERROR_INVALID_ARGUMENT with one line for the first
/// that is not allowed.
lobe_result passes_settings_check(const lobe_filter *filter, const lobe_settings *settings,
                                  const lobe_host *host);

/// Checks that a device has the features that knobs need which are not at their defaults.
/// LOBE_ERROR_UNSUPPORTED with one line for the first that it lacks.
lobe_result passes_settings_check_device(const lobe_filter *filter, const lobe_settings *settings,
                                         const lobe_device_information *device,
                                         const lobe_host *host);

#endif
