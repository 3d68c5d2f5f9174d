#include <math.h>
#include <string.h>

#include "scenes/gltf/gltf.h"

static size_t component_size(int component) {
    switch (component) {
    case GLTF_BYTE:
    case GLTF_UNSIGNED_BYTE:
        return 1;
    case GLTF_SHORT:
    case GLTF_UNSIGNED_SHORT:
        return 2;
    case GLTF_UNSIGNED_INT:
    case GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

lobe_result scenes_gltf_open_view(const gltf_import *import, int view, const char *what,
                                  const uint8_t **bytes, size_t *length, size_t *stride) {
    const gltf_document *document = import->document;
    if (view < 0 || (size_t)view >= document->view_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: there is no buffer view %d", import->path, what, view);
    const gltf_view *v = &document->views[view];
    if (v->buffer < 0 || (size_t)v->buffer >= document->buffer_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: buffer view %d: there is no buffer %d", import->path, view,
                              v->buffer);
    const gltf_buffer *buffer = &document->buffers[v->buffer];
    if (v->offset > buffer->size || v->length > buffer->size - v->offset)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: buffer view %d: %zu bytes from %zu on end beyond the %zu "
                              "bytes of buffer %d",
                              import->path, view, v->length, v->offset, buffer->size, v->buffer);
    *bytes = buffer->data + v->offset;
    *length = v->length;
    *stride = v->stride;
    return LOBE_OK;
}

typedef struct element_range {
    int view;
    size_t offset, count, size; // of one element
    bool strided;               // the view's stride applies
} element_range;

// Finds `range->count` elements of a view. Divides instead of multiplying, so nothing overflows.
static lobe_result open_range(const gltf_import *import, const element_range *range,
                              const char *what, const uint8_t **bytes, size_t *stride) {
    size_t length = 0, view_stride = 0;
    lobe_result result =
        scenes_gltf_open_view(import, range->view, what, bytes, &length, &view_stride);
    if (result != LOBE_OK)
        return result;
    *stride = range->strided && view_stride > 0 ? view_stride : range->size;
    if (*stride < range->size)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: elements of %zu bytes overlap at a stride of %zu",
                              import->path, what, range->size, *stride);
    bool fits = range->offset <= length && length - range->offset >= range->size &&
                (length - range->offset - range->size) / *stride >= range->count - 1;
    if (!fits)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: %zu elements end beyond the %zu bytes of buffer view "
                              "%d",
                              import->path, what, range->count, length, range->view);
    *bytes += range->offset;
    return LOBE_OK;
}

static uint32_t load_unsigned(const uint8_t *bytes, int component) {
    uint16_t u16;
    uint32_t u32;
    switch (component) {
    case GLTF_UNSIGNED_BYTE:
        return bytes[0];
    case GLTF_UNSIGNED_SHORT:
        memcpy(&u16, bytes, sizeof u16);
        return u16;
    default:
        memcpy(&u32, bytes, sizeof u32);
        return u32;
    }
}

static bool is_unsigned(int component) {
    return component == GLTF_UNSIGNED_BYTE || component == GLTF_UNSIGNED_SHORT ||
           component == GLTF_UNSIGNED_INT;
}

static uint32_t sparse_index(const gltf_elements *elements, size_t i) {
    size_t size = component_size(elements->sparse_component);
    return load_unsigned(elements->sparse_indices + i * size, elements->sparse_component);
}

// The format requires increasing indices, and the binary search below needs them.
static lobe_result check_sparse_indices(const gltf_import *import, const gltf_elements *elements,
                                        const char *what) {
    for (size_t i = 0; i < elements->sparse_count; i++) {
        uint32_t index = sparse_index(elements, i);
        if (index >= elements->count)
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: %s: sparse index %u of %zu elements", import->path, what,
                                  index, elements->count);
        if (i > 0 && index <= sparse_index(elements, i - 1))
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: %s: sparse indices do not increase", import->path, what);
    }
    return LOBE_OK;
}

static lobe_result open_sparse(const gltf_import *import, const gltf_sparse *sparse,
                               size_t element_size, const char *what, gltf_elements *elements) {
    if (!is_unsigned(sparse->index_component) || sparse->count > elements->count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: %zu sparse indices of type %d", import->path, what,
                              sparse->count, sparse->index_component);
    element_range indices = {sparse->index_view, sparse->index_offset, sparse->count,
                             component_size(sparse->index_component), false};
    element_range values = {sparse->value_view, sparse->value_offset, sparse->count, element_size,
                            false};
    size_t stride;
    lobe_result result = open_range(import, &indices, what, &elements->sparse_indices, &stride);
    if (result == LOBE_OK)
        result = open_range(import, &values, what, &elements->sparse_values, &stride);
    if (result != LOBE_OK)
        return result;
    elements->sparse_count = sparse->count;
    elements->sparse_component = sparse->index_component;
    return check_sparse_indices(import, elements, what);
}

static lobe_result check_type(const gltf_import *import, const gltf_accessor *accessor,
                              const char *what, unsigned most_channels) {
    if (accessor->channels == 0 || accessor->channels > most_channels ||
        component_size(accessor->component) == 0)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: a matrix, or components of unknown type %d", import->path,
                              what, accessor->component);
    if (accessor->count == 0)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: %s: has no elements",
                              import->path, what);
    if (accessor->view < 0 && accessor->count > GLTF_MAXIMUM_ZERO_ELEMENTS)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                              "%s: %s: %zu elements without a buffer view, at most %zu",
                              import->path, what, accessor->count, GLTF_MAXIMUM_ZERO_ELEMENTS);
    return LOBE_OK;
}

static lobe_result open_accessor(const gltf_import *import, int accessor, const char *what,
                                 unsigned most_channels, gltf_elements *elements) {
    *elements = (gltf_elements){0};
    if (accessor < 0 || (size_t)accessor >= import->document->accessor_count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED, "%s: %s: there is no accessor %d",
                              import->path, what, accessor);
    const gltf_accessor *a = &import->document->accessors[accessor];
    lobe_result result = check_type(import, a, what, most_channels);
    if (result != LOBE_OK)
        return result;
    size_t size = component_size(a->component) * a->channels;
    elements->count = a->count;
    elements->stride = size;
    elements->component = a->component;
    elements->channels = a->channels;
    elements->normalised = a->normalised && a->component != GLTF_FLOAT;
    element_range range = {a->view, a->offset, a->count, size, true};
    if (a->view >= 0)
        result = open_range(import, &range, what, &elements->bytes, &elements->stride);
    if (result == LOBE_OK && a->sparse.count > 0)
        result = open_sparse(import, &a->sparse, size, what, elements);
    return result;
}

lobe_result scenes_gltf_open_accessor(const gltf_import *import, int accessor, const char *what,
                                      gltf_elements *elements) {
    return open_accessor(import, accessor, what, 4, elements);
}

lobe_result scenes_gltf_open_matrices(const gltf_import *import, int accessor, const char *what,
                                      gltf_elements *elements) {
    lobe_result result = open_accessor(import, accessor, what, 16, elements);
    if (result != LOBE_OK || (elements->channels == 16 && elements->component == GLTF_FLOAT))
        return result;
    return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                          "%s: %s: %u components of type %d; expected matrices of 4x4 floats",
                          import->path, what, elements->channels, elements->component);
}

// The bytes of element `i`, looked up among the sparse ones first; NULL: zero.
static const uint8_t *find_element(const gltf_elements *elements, size_t i) {
    size_t low = 0, high = elements->sparse_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (sparse_index(elements, middle) < i)
            low = middle + 1;
        else
            high = middle;
    }
    size_t size = component_size(elements->component) * elements->channels;
    if (low < elements->sparse_count && sparse_index(elements, low) == i)
        return elements->sparse_values + low * size;
    return elements->bytes ? elements->bytes + i * elements->stride : NULL;
}

// glTF 2.0, section 3.6.2.2: conversions between integers and normalised floats.
static float load_float(const uint8_t *bytes, int component, bool normalised) {
    float f;
    int16_t s16;
    switch (component) {
    case GLTF_FLOAT:
        memcpy(&f, bytes, sizeof f);
        return f;
    case GLTF_BYTE:
        return normalised ? fmaxf((int8_t)bytes[0] / 127.0f, -1) : (int8_t)bytes[0];
    case GLTF_SHORT:
        memcpy(&s16, bytes, sizeof s16);
        return normalised ? fmaxf(s16 / 32767.0f, -1) : s16;
    case GLTF_UNSIGNED_BYTE:
        return normalised ? bytes[0] / 255.0f : bytes[0];
    case GLTF_UNSIGNED_SHORT:
        f = (float)load_unsigned(bytes, component);
        return normalised ? f / 65535.0f : f;
    default:
        f = (float)load_unsigned(bytes, component);
        return normalised ? f / 4294967295.0f : f;
    }
}

void scenes_gltf_read_floats(const gltf_elements *elements, size_t i, float out[4]) {
    const uint8_t *bytes = find_element(elements, i);
    size_t size = component_size(elements->component);
    for (unsigned c = 0; c < elements->channels; c++)
        out[c] =
            bytes ? load_float(bytes + c * size, elements->component, elements->normalised) : 0;
}

void scenes_gltf_read_matrix(const gltf_elements *elements, size_t i, float out[16]) {
    const uint8_t *bytes = find_element(elements, i);
    memset(out, 0, 16 * sizeof *out);
    if (bytes)
        memcpy(out, bytes, 16 * sizeof *out);
}

uint32_t scenes_gltf_read_index(const gltf_elements *elements, size_t i) {
    const uint8_t *bytes = find_element(elements, i);
    return bytes ? load_unsigned(bytes, elements->component) : 0;
}
