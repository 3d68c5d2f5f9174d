#include "tools/cli/cache_folder.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// mkdir fails if the folder exists, which is fine; other failures become apparent later.
static bool make(const char *path) {
    struct stat status;
    mkdir(path, 0700);
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static bool append(char *path, const char *name) {
    size_t length = strlen(path);
    if (length + strlen(name) + sizeof "/" > CACHE_FOLDER_SIZE)
        return false;
    sprintf(path + length, "/%s", name);
    return make(path);
}

const char *cache_folder_find(const char *name, char *path) {
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    bool usable;
    if (cache && cache[0] == '/') {
        usable = snprintf(path, CACHE_FOLDER_SIZE, "%s", cache) < CACHE_FOLDER_SIZE && make(path);
    } else {
        usable = home && home[0] == '/' &&
                 snprintf(path, CACHE_FOLDER_SIZE, "%s", home) < CACHE_FOLDER_SIZE &&
                 append(path, ".cache");
    }
    usable = usable && append(path, "lobe") && (!name || append(path, name));
    return usable ? path : NULL;
}
