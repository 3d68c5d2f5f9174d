#ifndef SCENES_FORMAT_LIBRARY_MEMORY_H
#define SCENES_FORMAT_LIBRARY_MEMORY_H

#include <lobe/host.h>

#include "third_party/library_memory.h"

static inline void *scenes_library_memory_resize(void *allocator, void *memory, size_t size) {
    return lobe_reallocate(allocator, memory, size, 1);
}

/// The host's allocator in the form that wrapped libraries take it.
static inline library_memory scenes_library_memory(const lobe_host *host) {
    return (library_memory){.resize = scenes_library_memory_resize,
                            .release = lobe_release,
                            .user = (void *)lobe_host_allocator(host)}; // only read
}

#endif
