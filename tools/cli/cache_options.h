#ifndef TOOLS_CLI_CACHE_OPTIONS_H
#define TOOLS_CLI_CACHE_OPTIONS_H

#include "tools/cli/cache_folder.h"
#include "tools/cli/options.h"

/// The options of every subcommand that caches the filtered cubes of environments or the fitted
/// mixtures of materials.
typedef struct cache_options {
    const char *folder; ///< NULL: in the user's cache folder
    bool off;
} cache_options;

/// Entries for an option table.
option cache_option_folder(cache_options *options);
option cache_option_off(cache_options *options);

/// 0, or the exit status of a usage error, which has been printed.
int cache_options_check(const option_table *table, const cache_options *options);

/// The folder for "environments" or "mixtures"; NULL if caching is off or there is no place for it.
/// `path`, of CACHE_FOLDER_SIZE bytes, holds it if it is the default one.
const char *cache_options_find(const cache_options *options, const char *name, char *path);

#endif
