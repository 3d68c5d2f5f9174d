#include "scenes/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scenes/report.h"

typedef struct opened_file {
    const char *path, *owner;
    const lobe_log *log;
    int descriptor;
    size_t size;
} opened_file;

static lobe_result fail(const opened_file *file, lobe_result result, const char *cause) {
    const char *owner = file->owner ? file->owner : "";
    return scene_report_error(file->log, result, "%s%s%s: %s", owner, *owner ? ": " : "",
                              file->path, cause);
}

static lobe_result open_file(opened_file *file) {
    // A pipe or a terminal in the place of a file must not make us wait: hence O_NONBLOCK.
    file->descriptor = open(file->path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file->descriptor < 0) {
        bool absent = errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG;
        return fail(file, absent ? LOBE_ERROR_NOT_FOUND : LOBE_ERROR_READ,
                    absent ? "no such file" : strerror(errno));
    }
    struct stat status;
    if (fstat(file->descriptor, &status) != 0)
        return fail(file, LOBE_ERROR_READ, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return fail(file, LOBE_ERROR_READ, "not a regular file");
    if ((uintmax_t)status.st_size > SCENE_FILE_MAXIMUM_SIZE)
        return fail(file, LOBE_ERROR_LIMIT, "larger than 2 GiB");
    file->size = (size_t)status.st_size;
    return LOBE_OK;
}

static lobe_result read_content(const opened_file *file, unsigned char *bytes) {
    size_t done = 0;
    while (done < file->size) {
        ssize_t part = read(file->descriptor, bytes + done, file->size - done);
        if (part < 0 && errno == EINTR)
            continue;
        if (part <= 0)
            return fail(file, LOBE_ERROR_READ, part < 0 ? strerror(errno) : "shrank while read");
        done += (size_t)part;
    }
    bytes[file->size] = 0;
    return LOBE_OK;
}

lobe_result scene_read_file(const char *path, const char *owner, const lobe_log *log, void **bytes,
                            size_t *size) {
    *bytes = NULL;
    *size = 0;
    opened_file file = {path, owner, log, -1, 0};
    unsigned char *content = NULL;
    lobe_result result = open_file(&file);
    if (result != LOBE_OK)
        goto cleanup;
    content = malloc(file.size + 1);
    if (!content) {
        result = fail(&file, LOBE_ERROR_OUT_OF_MEMORY, "out of memory");
        goto cleanup;
    }
    result = read_content(&file, content);
    if (result != LOBE_OK)
        goto cleanup;
    *bytes = content;
    *size = file.size;
    content = NULL;
cleanup:
    free(content);
    if (file.descriptor >= 0)
        close(file.descriptor);
    return result;
}
