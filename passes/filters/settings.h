#ifndef PASSES_FILTERS_SETTINGS_H
#define PASSES_FILTERS_SETTINGS_H

#include <lobe/device.h>
#include <lobe/filter.h>

/// The filter that a host asked for (NULL: "moments"), and its settings (NULL: the defaults).
/// LOBE_ERROR_INVALID_ARGUMENT with one line for the first value that its knob does not allow,
/// LOBE_ERROR_UNSUPPORTED for one that needs a feature which the device lacks.
lobe_result passes_settings_choose(const lobe_filter *wanted, const lobe_settings *given,
                                   const lobe_device_information *device, const lobe_host *host,
                                   const lobe_filter **filter, lobe_settings *settings);

#endif
