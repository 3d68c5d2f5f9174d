#include "scenes/gltf/pointer/pointer_nodes.h"

lobe_result scenes_pointer_nodes_add(pointer_nodes *nodes, size_t place, const char *path,
                                     const lobe_host *host) {
    // The capacity is the power of two not below the count.
    if ((nodes->count & (nodes->count - 1)) == 0) {
        const size_t room = nodes->count > 0 ? 2 * nodes->count : 1;
        size_t *larger =
            lobe_reallocate(lobe_host_allocator(host), nodes->places, room, sizeof *larger);
        if (!larger)
            return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
        nodes->places = larger;
    }
    nodes->places[nodes->count++] = place;
    return LOBE_OK;
}

lobe_result scenes_pointer_nodes_insert(const pointer_nodes *nodes, gltf_container *container,
                                        const char *path, const lobe_host *host) {
    return scenes_gltf_container_insert(container, nodes->places, nodes->count, "\"node\":0,", path,
                                        host);
}
