#include "scenes/format/path_in_folder.h"

#include <stdio.h>
#include <string.h>

char *path_in_folder(const char *folder, const char *file, const lobe_log *log) {
    const size_t size = strlen(folder) + strlen(file) + 2;
    char *path = lobe_allocate(lobe_log_allocator(log), size, 1);
    if (path)
        snprintf(path, size, "%s/%s", folder, file);
    return path;
}
