#include "tools/cli/cache_options.h"

#include <stddef.h>

option cache_option_folder(cache_options *options) {
    return (option){
        .name = "cache",
        .kind = OPTION_TEXT,
        .argument = "DIR",
        .summary =
            "cache folder for the filtered cubes of environments and the mixtures and reliefs of "
            "materials (default: lobe/environments, lobe/mixtures in the user's cache "
            "folder)",
        .target = &options->folder,
    };
}

option cache_option_off(cache_options *options) {
    return (option){
        .name = "no-cache",
        .kind = OPTION_FLAG,
        .summary = "neither load nor save filtered cubes, mixtures and reliefs",
        .target = &options->off,
    };
}

int cache_options_check(const option_table *table, const cache_options *options) {
    if (options->folder && options->off)
        return options_usage_error(table, "--cache: not together with --no-cache");
    return 0;
}

const char *cache_options_find(const cache_options *options, const char *name, char *path) {
    if (options->off)
        return NULL;
    return options->folder ? options->folder : cache_folder_find(name, path);
}
