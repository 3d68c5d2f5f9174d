#include "scenes/format/library_memory.h"

static void *resize(void *allocator, void *memory, size_t size) {
    return lobe_reallocate(allocator, memory, size, 1);
}

library_memory scenes_library_memory(const lobe_host *host) {
    return (library_memory){.resize = resize,
                            .release = lobe_release,
                            .user = (void *)lobe_host_allocator(host)}; // only read
}
