#include <stdio.h>

#include "scenes/gltf/gltf.h"

// The vertices of a primitive in drawing order: indexed, or consecutive.
typedef struct vertex_order {
    gltf_elements elements;
    bool indexed;
    size_t count;
} vertex_order;

static lobe_result open_order(const gltf_import *import, const gltf_primitive *primitive,
                              const char *name, size_t element_count, vertex_order *order) {
    *order = (vertex_order){.indexed = primitive->indices >= 0, .count = element_count};
    if (!order->indexed)
        return LOBE_OK;
    char what[192];
    snprintf(what, sizeof what, "indices of %s", name);
    lobe_result result =
        scenes_gltf_open_accessor(import, primitive->indices, what, &order->elements);
    if (result != LOBE_OK)
        return result;
    int component = order->elements.component;
    bool integers = component == GLTF_UNSIGNED_BYTE || component == GLTF_UNSIGNED_SHORT ||
                    component == GLTF_UNSIGNED_INT;
    if (!integers || order->elements.channels != 1)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s are not single unsigned integers", import->path, what);
    order->count = order->elements.count;
    return LOBE_OK;
}

static uint32_t order_at(const vertex_order *order, size_t i) {
    return order->indexed ? scenes_gltf_read_index(&order->elements, i) : (uint32_t)i;
}

static lobe_result count_triangles(const gltf_import *import, int mode, const char *name,
                                   size_t count, size_t *triangles) {
    bool list = mode == GLTF_TRIANGLES;
    if (count < 3 || (list && count % 3 != 0))
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: triangles of %zu vertices", import->path, name, count);
    *triangles = list ? count / 3 : count - 2;
    if (*triangles > (GLTF_MAXIMUM_INDICES - import->indices) / 3)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                              "%s: %s: more than %zu indices in the scene", import->path, name,
                              GLTF_MAXIMUM_INDICES);
    return LOBE_OK;
}

// glTF 2.0, section 3.7.2.1: the vertices of triangle `t` of a list, strip or fan.
static void triangle_corners(int mode, size_t t, size_t corner[3]) {
    size_t odd = t % 2;
    switch (mode) {
    case GLTF_TRIANGLE_STRIP:
        corner[0] = t;
        corner[1] = t + 1 + odd;
        corner[2] = t + 2 - odd;
        break;
    case GLTF_TRIANGLE_FAN:
        corner[0] = t + 1;
        corner[1] = t + 2;
        corner[2] = 0;
        break;
    default:
        for (size_t k = 0; k < 3; k++)
            corner[k] = 3 * t + k;
    }
}

lobe_result scenes_gltf_read_triangles(const gltf_import *import, const gltf_primitive *primitive,
                                       const char *name, size_t element_count, uint32_t **indices,
                                       size_t *index_count) {
    vertex_order order;
    size_t triangles = 0;
    *indices = NULL;
    lobe_result result = open_order(import, primitive, name, element_count, &order);
    if (result == LOBE_OK)
        result = count_triangles(import, primitive->mode, name, order.count, &triangles);
    if (result != LOBE_OK)
        return result;
    uint32_t *list = lobe_allocate(lobe_host_allocator(import->host), 3 * triangles, sizeof *list);
    if (!list)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY,
                              "%s: %s: out of memory for triangles", import->path, name);
    for (size_t t = 0; t < triangles; t++) {
        size_t corner[3];
        triangle_corners(primitive->mode, t, corner);
        for (size_t k = 0; k < 3; k++) {
            uint32_t index = order_at(&order, corner[k]);
            list[3 * t + k] = index;
            if (index < element_count)
                continue;
            lobe_release(list);
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: %s: index %zu is %u, of %zu vertices", import->path, name,
                                  corner[k], index, element_count);
        }
    }
    *indices = list;
    *index_count = 3 * triangles;
    return LOBE_OK;
}
