#ifndef TOOLS_CLI_DEVICE_OPTIONS_H
#define TOOLS_CLI_DEVICE_OPTIONS_H

#include <stdbool.h>

#include <lobe/device.h>

#include "tools/cli/options.h"

/// The options of every subcommand that needs a device.
typedef struct device_options {
    const char *select; ///< NULL: LOBE_DEVICE, if set; else the most suitable device
    bool validation;
} device_options;

/// Entries for an option table.
option device_option_select(device_options *options);
option device_option_validation(device_options *options);

/// The value for lobe_device_parameters.select; NULL: the most suitable.
const char *device_options_selection(const device_options *options);
/// Path of the cache file for compiled pipelines, written to `path` of CACHE_FOLDER_SIZE bytes (see
/// tools/cli/cache_folder.h); NULL if there is no place for it.
const char *device_options_pipeline_cache(char *path);

/// Opens the device, with a pipeline cache in the user's cache folder ($XDG_CACHE_HOME/lobe or
/// ~/.cache/lobe) if there is one.
lobe_result device_options_open(const device_options *options, const lobe_host *host,
                                lobe_device **device);

/// LOBE_ERROR_UNSUPPORTED, with a message, if the validation layer reported errors, else LOBE_OK.
lobe_result device_options_check(const lobe_device *device, const lobe_host *host);

#endif
