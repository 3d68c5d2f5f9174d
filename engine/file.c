#include "engine/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/text.h"

// ---------------------------------------------------------------------------------------------
// Reading

static lobe_result fail_reading(const char *path, const lobe_log *log) {
    lobe_result result = errno == ENOENT ? LOBE_ERROR_NOT_FOUND : LOBE_ERROR_READ;
    return engine_fail(log, result, "%s: cannot be read: %s", path, strerror(errno));
}

/// Bytes to reserve: one more than the file seems to have, so that its end is met without growing.
static lobe_result expected_size(int file, const char *path, const lobe_log *log, size_t *size) {
    struct stat status;
    if (fstat(file, &status) != 0)
        return fail_reading(path, log);
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
        return engine_fail(log, LOBE_ERROR_READ, "%s: cannot be read: not a regular file", path);
    if ((uint64_t)status.st_size > ENGINE_FILE_MAXIMUM_SIZE)
        return engine_fail(log, LOBE_ERROR_LIMIT, "%s: larger than %zu bytes", path,
                           ENGINE_FILE_MAXIMUM_SIZE);
    *size = S_ISREG(status.st_mode) ? (size_t)status.st_size + 1 : 65536;
    return LOBE_OK;
}

static lobe_result read_to_end(int file, const char *path, const lobe_log *log, size_t capacity,
                               uint8_t **data, size_t *size) {
    for (*size = 0;;) {
        if (*data == NULL || *size == capacity) {
            capacity = *data == NULL ? capacity : 2 * capacity;
            uint8_t *larger = realloc(*data, capacity);
            if (larger == NULL)
                return engine_fail(log, LOBE_ERROR_OUT_OF_MEMORY, "%s: no memory to read it", path);
            *data = larger;
        }
        ssize_t count = read(file, *data + *size, capacity - *size);
        if (count < 0 && errno != EINTR)
            return fail_reading(path, log);
        if (count == 0)
            return LOBE_OK;
        *size += count > 0 ? (size_t)count : 0;
        if (*size > ENGINE_FILE_MAXIMUM_SIZE)
            return engine_fail(log, LOBE_ERROR_LIMIT, "%s: larger than %zu bytes", path,
                               ENGINE_FILE_MAXIMUM_SIZE);
    }
}

lobe_result engine_file_read(const char *path, const lobe_log *log, uint8_t **data, size_t *size) {
    *data = NULL;
    *size = 0;
    int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return fail_reading(path, log);
    size_t capacity = 0;
    lobe_result result = expected_size(file, path, log, &capacity);
    if (result == LOBE_OK)
        result = read_to_end(file, path, log, capacity, data, size);
    if (result != LOBE_OK) {
        free(*data);
        *data = NULL;
        *size = 0;
    }
    close(file);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Writing

static lobe_result fail_writing(const char *path, const lobe_log *log) {
    return engine_fail(log, LOBE_ERROR_WRITE, "%s: cannot be written: %s", path, strerror(errno));
}

/// Closes the file in all cases. Returns 0, or -1 with errno set.
static int write_all(int file, const uint8_t *data, size_t size) {
    int error = 0;
    while (size > 0 && error == 0) {
        ssize_t count = write(file, data, size);
        if (count >= 0) {
            data += count;
            size -= (size_t)count;
        } else if (errno != EINTR) {
            error = errno;
        }
    }
    // Some file systems report a full disk only when the file is closed.
    if (close(file) != 0 && error == 0)
        error = errno;
    errno = error;
    return error == 0 ? 0 : -1;
}

static lobe_result write_directly(const char *path, const void *data, size_t size,
                                  const lobe_log *log) {
    int file = open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0 || write_all(file, data, size) != 0)
        return fail_writing(path, log);
    return LOBE_OK;
}

/// Creates a file of a new name in the folder of `path`. The name does not contain that of
/// `path`, which may already be as long as names may be.
static int create_temporary(const char *path, char *name, size_t name_size) {
    const char *slash = strrchr(path, '/');
    int folder = slash != NULL ? (int)(slash - path) + 1 : 0;
    int file = -1;
    for (unsigned attempt = 0; file < 0 && attempt < 100; attempt++) {
        snprintf(name, name_size, "%.*s.lobe-%ld-%u", folder, path, (long)getpid(), attempt);
        file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0 && errno != EEXIST)
            break;
    }
    return file;
}

static lobe_result write_and_rename(const char *path, const void *data, size_t size,
                                    const lobe_log *log) {
    size_t name_size = strlen(path) + 64;
    char *name = malloc(name_size);
    if (name == NULL)
        return fail_writing(path, log);
    lobe_result result = LOBE_OK;
    int file = create_temporary(path, name, name_size);
    if (file < 0) {
        result = fail_writing(path, log);
    } else if (write_all(file, data, size) != 0 || rename(name, path) != 0) {
        result = fail_writing(path, log);
        unlink(name);
    }
    free(name);
    return result;
}

lobe_result engine_file_write(const char *path, const void *data, size_t size,
                              const lobe_log *log) {
    struct stat status;
    if (stat(path, &status) != 0)
        return write_and_rename(path, data, size, log);
    if (!S_ISREG(status.st_mode))
        return write_directly(path, data, size, log);
    // Through a symbolic link the file it points to is replaced, not the link.
    char *target = realpath(path, NULL);
    if (target == NULL)
        return fail_writing(path, log);
    lobe_result result = write_and_rename(target, data, size, log);
    free(target);
    return result;
}
