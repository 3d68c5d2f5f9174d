#include "tools/cli/device_options.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/cache_folder.h"

option device_option_select(device_options *options) {
    return (option){
        .name = "device",
        .kind = OPTION_TEXT,
        .argument = "NAME",
        .summary = "the device: part of its name, or its number in 'lobe info' (default: "
                   "environment variable LOBE_DEVICE, or else the most suitable)",
        .target = &options->select,
    };
}

option device_option_validation(device_options *options) {
    return (option){
        .name = "validation",
        .kind = OPTION_FLAG,
        .summary =
            "turn on Vulkan's validation layer, including synchronisation validation; fail if "
            "it reports errors",
        .target = &options->validation,
    };
}

const char *device_options_selection(const device_options *options) {
    const char *select = options->select ? options->select : getenv("LOBE_DEVICE");
    return select && select[0] == '\0' ? NULL : select;
}

const char *device_options_pipeline_cache(char *path) {
    static const char name[] = "/pipelines";
    if (!cache_folder_find(NULL, path) || strlen(path) + sizeof name > CACHE_FOLDER_SIZE)
        return NULL;
    return strcat(path, name);
}

lobe_result device_options_open(const device_options *options, const lobe_host *host,
                                lobe_device **device) {
    char cache[CACHE_FOLDER_SIZE];
    return lobe_device_create(
        &(lobe_device_parameters){
            .select = device_options_selection(options),
            .validation = options->validation,
            .pipeline_cache = device_options_pipeline_cache(cache),
            .host = host,
        },
        device);
}

lobe_result device_options_check(const lobe_device *device, const lobe_host *host) {
    uint64_t count = lobe_device_validation_count(device);
    if (count == 0)
        return LOBE_OK;
    lobe_host_log(host, LOBE_LOG_ERROR, "the validation layer reported %" PRIu64 " errors", count);
    return LOBE_ERROR_UNSUPPORTED;
}
