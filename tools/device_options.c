#include "tools/device_options.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

option device_option_select(device_options *options) {
    return (option){
        .name = "device",
        .kind = OPTION_TEXT,
        .argument = "NAME",
        .summary = "the device: a part of its name or its number in 'lobe info' (default: "
                   "environment variable LOBE_DEVICE, or else the best suited)",
        .target = &options->select,
    };
}

option device_option_validation(device_options *options) {
    return (option){
        .name = "validation",
        .kind = OPTION_FLAG,
        .summary = "turn on Vulkan's validation layer, synchronisation validation too; fail where "
                   "it finds fault",
        .target = &options->validation,
    };
}

/// Makes the folder where the cache lives. False where there is no place for one: then lobe works
/// without.
static bool find_cache(char *path, size_t size) {
    const char *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    int length;
    if (cache && cache[0] == '/')
        length = snprintf(path, size, "%s", cache);
    else if (home && home[0] == '/')
        length = snprintf(path, size, "%s/.cache", home);
    else
        return false;
    if (length < 0 || (size_t)length + sizeof "/lobe/pipelines" > size)
        return false;
    // Existing folders make mkdir fail, which is fine; any other failure shows in the last stat.
    mkdir(path, 0700);
    snprintf(path + length, size - (size_t)length, "/lobe");
    mkdir(path, 0700);
    struct stat status;
    bool usable = stat(path, &status) == 0 && S_ISDIR(status.st_mode);
    snprintf(path + length, size - (size_t)length, "/lobe/pipelines");
    return usable;
}

lobe_result device_options_open(const device_options *options, const lobe_log *log,
                                lobe_device **device) {
    char cache[4096];
    const char *select = options->select ? options->select : getenv("LOBE_DEVICE");
    if (select && select[0] == '\0')
        select = NULL;
    return lobe_device_create(
        &(lobe_device_parameters){
            .select = select,
            .validation = options->validation,
            .pipeline_cache = find_cache(cache, sizeof cache) ? cache : NULL,
            .log = log,
        },
        device);
}

lobe_result device_options_check(const lobe_device *device, const lobe_log *log) {
    uint64_t count = lobe_device_validation_count(device);
    if (count == 0)
        return LOBE_OK;
    lobe_log_print(log, LOBE_LOG_ERROR, "the validation layer found %" PRIu64 " faults", count);
    return LOBE_ERROR_UNSUPPORTED;
}
