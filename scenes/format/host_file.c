#include "scenes/format/host_file.h"

#include <string.h>

lobe_result scenes_host_file_copy(const char *path, const void *content, size_t content_size,
                                  const lobe_host *host, uint8_t **data, size_t *size) {
    *data = NULL;
    *size = 0;
    if (content_size > LOBE_FILE_MAXIMUM_SIZE)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT, "%s: more than %zu bytes", path,
                              LOBE_FILE_MAXIMUM_SIZE);
    uint8_t *copy = lobe_allocate(lobe_host_allocator(host), content_size + 1, 1);
    if (!copy)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
    if (content_size > 0)
        memcpy(copy, content, content_size);
    copy[content_size] = 0;
    *data = copy;
    *size = content_size;
    return LOBE_OK;
}

lobe_result scenes_host_file_read(const lobe_file_source *files, const char *path,
                                  const char *owner, const lobe_host *host, uint8_t **data,
                                  size_t *size) {
    if (!files)
        return lobe_file_read(path, owner, host, data, size);
    const void *content = NULL;
    size_t content_size = 0;
    *data = NULL;
    *size = 0;
    lobe_result result = files->read(files->user, path, &content, &content_size);
    if (result != LOBE_OK)
        return lobe_host_fail(host, result, "%s%s%s: %s", owner ? owner : "", owner ? ": " : "",
                              path, lobe_result_message(result));
    result = scenes_host_file_copy(path, content, content_size, host, data, size);
    if (files->release)
        files->release(files->user, content, content_size);
    return result;
}
