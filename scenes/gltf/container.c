#include "scenes/gltf/container.h"

#include <stdint.h>
#include <string.h>

// glTF 2.0, section 4: the file header and the chunk headers.
#define GLB_HEADER_SIZE     12
#define GLB_CHUNK_HEAD_SIZE 8
#define GLB_CHUNK_JSON      0x4e4f534au
#define GLB_CHUNK_BINARY    0x004e4942u

typedef struct glb_chunk {
    uint32_t type;
    size_t begin, end; // of the content
} glb_chunk;

static uint32_t read_word(const char *bytes) {
    const unsigned char *b = (const unsigned char *)bytes;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static void write_word(char *bytes, uint32_t word) {
    for (int i = 0; i < 4; i++)
        bytes[i] = (char)(word >> 8 * i);
}

static const char *read_chunk(const gltf_container *container, size_t at, glb_chunk *chunk) {
    if (container->size - at < GLB_CHUNK_HEAD_SIZE)
        return "ends inside a chunk header";
    size_t length = read_word(container->bytes + at);
    chunk->type = read_word(container->bytes + at + 4);
    chunk->begin = at + GLB_CHUNK_HEAD_SIZE;
    chunk->end = chunk->begin + length;
    if (length > container->size - chunk->begin)
        return "a chunk is longer than the file";
    if (length % 4 != 0)
        return "the length of a chunk is not a multiple of 4";
    return NULL;
}

// Chunks after the second belong to extensions, and so does the second unless it is binary.
static const char *open_binary(gltf_container *container) {
    glb_chunk json, binary;
    const char *fault = read_chunk(container, GLB_HEADER_SIZE, &json);
    if (fault)
        return fault;
    if (json.type != GLB_CHUNK_JSON)
        return "the first chunk is not JSON";
    container->json = container->bytes + json.begin;
    container->json_size = json.end - json.begin;
    size_t end = json.end;
    if (end < container->size) {
        fault = read_chunk(container, end, &binary);
        if (fault)
            return fault;
        bool used = binary.type == GLB_CHUNK_BINARY && binary.end > binary.begin;
        end = used ? binary.end : end;
    }
    container->size = end;
    write_word(container->bytes + 8, (uint32_t)end);
    return NULL;
}

static const char *open_text(gltf_container *container) {
    static const char mark[] = "\xef\xbb\xbf"; // byte order mark, which some editors write
    size_t skipped = container->size >= 3 && memcmp(container->bytes, mark, 3) == 0 ? 3 : 0;
    container->json = container->bytes + skipped;
    container->json_size = container->size - skipped;
    size_t space = 0;
    while (space < container->json_size && memchr(" \t\r\n", container->json[space], 4))
        space++;
    if (space == container->json_size)
        return "is empty";
    return container->json[space] == '{' ? NULL : "is neither GLB nor JSON text of glTF";
}

static lobe_result check_version(const gltf_container *container, const char *path,
                                 const lobe_host *host) {
    uint32_t version = container->size >= 8 ? read_word(container->bytes + 4) : 2;
    if (version == 2)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_UNSUPPORTED, "%s: GLB version %u, lobe reads version 2",
                          path, version);
}

static const char *open_header(gltf_container *container) {
    if (container->size < GLB_HEADER_SIZE)
        return "ends inside the header of a GLB file";
    uint32_t length = read_word(container->bytes + 8);
    if (length > container->size)
        return "is shorter than its header says";
    container->size = length < GLB_HEADER_SIZE ? GLB_HEADER_SIZE : length;
    return open_binary(container);
}

lobe_result scenes_gltf_container_open(gltf_container *container, const char *path,
                                       const lobe_host *host) {
    container->binary = container->size >= 4 && memcmp(container->bytes, "glTF", 4) == 0;
    lobe_result result = container->binary ? check_version(container, path, host) : LOBE_OK;
    if (result != LOBE_OK)
        return result;
    const char *fault = container->binary ? open_header(container) : open_text(container);
    if (!fault)
        return LOBE_OK;
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: %s", path, fault);
}

// ---------------------------------------------------------------------------------------------
// Insertions

/// Returns where the text ends.
static char *write_with(char *to, const gltf_container *container, const size_t *places,
                        size_t count, const char *text) {
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        memcpy(to, container->json + at, places[i] - at);
        to += places[i] - at;
        memcpy(to, text, strlen(text));
        to += strlen(text);
        at = places[i];
    }
    memcpy(to, container->json + at, container->json_size - at);
    return to + (container->json_size - at);
}

lobe_result scenes_gltf_container_insert(gltf_container *container, const size_t *places,
                                         size_t count, const char *text, const char *path,
                                         const lobe_host *host) {
    if (count == 0)
        return LOBE_OK;
    const size_t head = (size_t)(container->json - container->bytes);
    const size_t tail = container->size - head - container->json_size;
    const size_t added = (count * strlen(text) + 3) / 4 * 4; // GLB's chunks are padded by spaces
    if (container->binary && container->size + added > UINT32_MAX)
        return lobe_host_fail(host, LOBE_ERROR_LIMIT, "%s: is larger than GLB can be", path);
    char *bytes = lobe_allocate(lobe_host_allocator(host), container->size + added, 1);
    if (!bytes)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", path);
    memcpy(bytes, container->bytes, head);
    char *end = write_with(bytes + head, container, places, count, text);
    memset(end, ' ', (size_t)(bytes + head + container->json_size + added - end));
    memcpy(bytes + head + container->json_size + added, container->json + container->json_size,
           tail);
    lobe_release(container->bytes);
    container->bytes = bytes;
    container->json = bytes + head;
    container->json_size += added;
    container->size += added;
    if (container->binary) {
        write_word(bytes + 8, (uint32_t)container->size);
        write_word(bytes + GLB_HEADER_SIZE, (uint32_t)container->json_size);
    }
    return LOBE_OK;
}
