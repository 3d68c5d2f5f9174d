#include "scenes/format/path_in_folder.h"

#include <stdio.h>
#include <string.h>

char *scenes_path_in_folder(const char *folder, const char *file, const lobe_host *host) {
    const size_t size = strlen(folder) + strlen(file) + 2;
    char *path = lobe_allocate(lobe_host_allocator(host), size, 1);
    if (path)
        snprintf(path, size, "%s/%s", folder, file);
    return path;
}
