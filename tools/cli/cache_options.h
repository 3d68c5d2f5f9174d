#ifndef TOOLS_CLI_CACHE_OPTIONS_H
#define TOOLS_CLI_CACHE_OPTIONS_H

#include "tools/cli/cache_folder.h"
#include "tools/cli/options.h"

/// The options of every subcommand that keeps the filtered cubes of environments for the next time.
typedef struct cache_options {
    const char *folder; ///< NULL: in the user's cache folder
    bool off;
} cache_options;

/// Entries for an option table.
option cache_option_folder(cache_options *options);
option cache_option_off(cache_options *options);

/// 0, or the status of a usage error that was told.
int cache_options_check(const option_table *table, const cache_options *options);

/// The folder; NULL where none is wanted, or there is no place for one. `path`, of
/// CACHE_FOLDER_SIZE bytes, holds it where it is the user's.
const char *cache_options_find(const cache_options *options, char *path);

#endif
