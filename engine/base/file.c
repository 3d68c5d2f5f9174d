#include <lobe/file.h>

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// ---------------------------------------------------------------------------------------------
// Reading

typedef struct file_reader {
    const char *path, *owner;
    const lobe_host *host;
    int file;
    uint8_t *data;
    size_t size, capacity; ///< bytes
} file_reader;

static lobe_result fail_reading(const file_reader *reader, lobe_result result, const char *cause) {
    const char *owner = reader->owner ? reader->owner : "";
    return lobe_host_fail(reader->host, result, "%s%s%s: %s", owner, *owner ? ": " : "",
                          reader->path, cause);
}

static lobe_result fail_too_large(const file_reader *reader) {
    return fail_reading(reader, LOBE_ERROR_LIMIT, "larger than 2 GiB");
}

static lobe_result open_regular_file(file_reader *reader) {
    // O_NONBLOCK: opening a pipe or a terminal must not block.
    reader->file = open(reader->path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (reader->file < 0) {
        const bool absent = errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG;
        return fail_reading(reader, absent ? LOBE_ERROR_NOT_FOUND : LOBE_ERROR_READ,
                            absent ? "no such file" : strerror(errno));
    }
    struct stat status;
    if (fstat(reader->file, &status) != 0)
        return fail_reading(reader, LOBE_ERROR_READ, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return fail_reading(reader, LOBE_ERROR_READ, "not a regular file");
    if ((uintmax_t)status.st_size > LOBE_FILE_MAXIMUM_SIZE)
        return fail_too_large(reader);
    // One byte more than the file's size, so that its end is found without growing.
    reader->capacity = (size_t)status.st_size + 1;
    return LOBE_OK;
}

/// Room for `capacity` bytes and a zero byte after them.
static lobe_result reserve(file_reader *reader) {
    uint8_t *larger =
        lobe_reallocate(lobe_host_allocator(reader->host), reader->data, reader->capacity + 1, 1);
    if (!larger)
        return fail_reading(reader, LOBE_ERROR_OUT_OF_MEMORY, "out of memory");
    reader->data = larger;
    return LOBE_OK;
}

static lobe_result read_to_end(file_reader *reader) {
    lobe_result result = reserve(reader);
    while (result == LOBE_OK) {
        const ssize_t count =
            read(reader->file, reader->data + reader->size, reader->capacity - reader->size);
        if (count == 0)
            break;
        if (count < 0 && errno != EINTR)
            return fail_reading(reader, LOBE_ERROR_READ, strerror(errno));
        reader->size += count > 0 ? (size_t)count : 0;
        if (reader->size > LOBE_FILE_MAXIMUM_SIZE)
            return fail_too_large(reader);
        if (reader->size == reader->capacity) {
            reader->capacity *= 2;
            result = reserve(reader);
        }
    }
    if (result == LOBE_OK)
        reader->data[reader->size] = 0;
    return result;
}

lobe_result lobe_file_read(const char *path, const char *owner, const lobe_host *host,
                           uint8_t **data, size_t *size) {
    if (data)
        *data = NULL;
    if (!path || !data || !size)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_file_read: path, data and size must not be NULL");
    *size = 0;
    file_reader reader = {.path = path, .owner = owner, .host = host};
    lobe_result result = open_regular_file(&reader);
    if (result == LOBE_OK)
        result = read_to_end(&reader);
    if (result == LOBE_OK) {
        *data = reader.data;
        *size = reader.size;
    } else {
        lobe_release(reader.data);
    }
    if (reader.file >= 0)
        close(reader.file);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Writing

static lobe_result fail_writing(const char *path, const lobe_host *host) {
    return lobe_host_fail(host, LOBE_ERROR_WRITE, "%s: cannot be written: %s", path,
                          strerror(errno));
}

/// Returns false with errno set.
static bool write_all(int file, const uint8_t *data, size_t size) {
    while (size > 0) {
        ssize_t count = write(file, data, size);
        if (count >= 0) {
            data += count;
            size -= (size_t)count;
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

/// Whether all was written, also when the file is closed: some file systems report a full disk only
/// then. `written`: so far; if false, errno is kept.
static bool close_written(int file, bool written) {
    const int error = errno;
    const bool closed = close(file) == 0;
    if (!written)
        errno = error;
    return written && closed;
}

static lobe_result write_directly(const char *path, const void *data, size_t size,
                                  const lobe_host *host) {
    int file = open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0 || !close_written(file, write_all(file, data, size)))
        return fail_writing(path, host);
    return LOBE_OK;
}

/// The length of the folder's part of a path, with its last slash.
static int folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash != NULL ? (int)(slash - path) + 1 : 0;
}

/// Creates a file with this name; or gives the name to `unnamed`, an open file that has none (-1:
/// there is no such file). Returns the file, or -1 with errno set.
static int create(const char *name, int unnamed) {
    if (unnamed < 0)
        return open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    char descriptor[32];
    snprintf(descriptor, sizeof descriptor, "/proc/self/fd/%d", unnamed);
    return linkat(AT_FDCWD, descriptor, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0 ? unnamed : -1;
}

/// The same with a new name in the folder of `path`. The name does not contain that of `path`,
/// which may already have the maximum length.
static int create_temporary(const char *path, int unnamed, char *name, size_t name_size) {
    int file = -1;
    for (unsigned attempt = 0; file < 0 && attempt < 100; attempt++) {
        snprintf(name, name_size, "%.*s.lobe-%ld-%u", folder_length(path), path, (long)getpid(),
                 attempt);
        file = create(name, unnamed);
        if (file < 0 && errno != EEXIST)
            break;
    }
    return file;
}

/// A file in the folder of `path` that is gone when it is closed, also by the end of a killed
/// program. -1: not every file system has these.
static int create_unnamed(const char *path, char *name, size_t name_size) {
    snprintf(name, name_size, "%.*s.", folder_length(path), path);
    return open(name, O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
}

/// Writes a file with a new name in the folder of `path`, which it has only once it is complete,
/// where the file system has files without names. Returns false with errno set, and `name` empty
/// if there is none.
static bool write_temporary(const char *path, const void *data, size_t size, char *name,
                            size_t name_size) {
    const int unnamed = create_unnamed(path, name, name_size);
    bool written = unnamed >= 0 && write_all(unnamed, data, size);
    *name = '\0';
    if (unnamed >= 0 && !written)
        return close_written(unnamed, false);
    int file = create_temporary(path, unnamed, name, name_size);
    // Without /proc, files cannot be named.
    if (file < 0 && unnamed >= 0) {
        close(unnamed);
        written = false;
        file = create_temporary(path, -1, name, name_size);
    }
    if (file < 0)
        *name = '\0';
    return file >= 0 && close_written(file, written || write_all(file, data, size));
}

static lobe_result write_and_rename(const char *path, const void *data, size_t size,
                                    const lobe_host *host) {
    size_t name_size = strlen(path) + 64;
    char *name = lobe_allocate(lobe_host_allocator(host), name_size, 1);
    if (name == NULL)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY,
                              "%s: cannot be written: out of memory", path);
    lobe_result result = LOBE_OK;
    if (!write_temporary(path, data, size, name, name_size) || rename(name, path) != 0) {
        result = fail_writing(path, host);
        if (*name)
            unlink(name);
    }
    lobe_release(name);
    return result;
}

lobe_result lobe_file_write(const char *path, const void *data, size_t size,
                            const lobe_host *host) {
    if (!path || (!data && size > 0))
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_file_write: path and data must not be NULL");
    struct stat status;
    if (stat(path, &status) != 0)
        return write_and_rename(path, data, size, host);
    if (!S_ISREG(status.st_mode))
        return write_directly(path, data, size, host);
    // If `path` is a symbolic link, replace its target and not the link.
    char target[PATH_MAX];
    if (realpath(path, target) == NULL)
        return fail_writing(path, host);
    return write_and_rename(target, data, size, host);
}
