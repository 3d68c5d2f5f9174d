#include "tools/cli/output_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/file.h>

bool output_file_has_ending(const char *path, const char *ending) {
    size_t length = strlen(path), ending_length = strlen(ending);
    return length > ending_length && strcasecmp(path + length - ending_length, ending) == 0;
}

static lobe_result cannot_write(const char *path, int error, const lobe_host *host) {
    lobe_host_log(host, LOBE_LOG_ERROR, "%s: cannot be written: %s", path, strerror(error));
    return LOBE_ERROR_WRITE;
}

/// Access rights alone are not enough: the file system may be full or read-only, the name too long.
static lobe_result try_to_create(const char *path, const lobe_host *host) {
    char *temporary = malloc(strlen(path) + sizeof ".XXXXXX");
    if (!temporary)
        return cannot_write(path, ENOMEM, host);
    sprintf(temporary, "%s.XXXXXX", path);
    int file = mkstemp(temporary);
    int error = errno;
    if (file >= 0) {
        close(file);
        unlink(temporary);
    }
    free(temporary);
    return file >= 0 ? LOBE_OK : cannot_write(path, error, host);
}

lobe_result output_file_check(const char *path, const lobe_host *host) {
    struct stat status;
    if (!path)
        return LOBE_OK;
    if (stat(path, &status) != 0 || S_ISREG(status.st_mode))
        return try_to_create(path, host);
    if (S_ISDIR(status.st_mode))
        return cannot_write(path, EISDIR, host);
    return access(path, W_OK) == 0 ? LOBE_OK : cannot_write(path, errno, host);
}

lobe_result output_file_write(const char *path, const char *text, const lobe_host *host) {
    return lobe_file_write(path, text, strlen(text), host);
}
