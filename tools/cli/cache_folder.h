#ifndef TOOLS_CLI_CACHE_FOLDER_H
#define TOOLS_CLI_CACHE_FOLDER_H

/// Bytes that a path needs at most.
#define CACHE_FOLDER_SIZE 4096

/// Makes the folder where lobe keeps what it would else compute again ($XDG_CACHE_HOME/lobe or
/// ~/.cache/lobe), and in it the folder `name`, where that is not NULL. Writes its path to `path`,
/// of CACHE_FOLDER_SIZE bytes, and returns it; NULL where there is no place for one: then lobe
/// works without.
const char *cache_folder_find(const char *name, char *path);

#endif
