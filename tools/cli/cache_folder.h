#ifndef TOOLS_CLI_CACHE_FOLDER_H
#define TOOLS_CLI_CACHE_FOLDER_H

/// Size of a buffer for any path.
#define CACHE_FOLDER_SIZE 4096

/// Creates lobe's cache folder ($XDG_CACHE_HOME/lobe or ~/.cache/lobe), and in it the folder `name`
/// unless that is NULL. Writes its path to `path`, of CACHE_FOLDER_SIZE bytes, and returns it; NULL
/// if there is no place for one, in which case lobe works without.
const char *cache_folder_find(const char *name, char *path);

#endif
