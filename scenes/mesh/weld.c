#include "scenes/mesh/weld.h"

#include <stddef.h>
#include <string.h>

typedef struct weld_key {
    float values[12];
} weld_key;

static weld_key key_of(const lobe_scene_vertex *vertex, uint32_t set, bool tangents) {
    weld_key key = {0};
    memcpy(key.values, vertex->position, sizeof vertex->position);
    memcpy(key.values + 3, vertex->normal, sizeof vertex->normal);
    memcpy(key.values + 6, vertex->texture_coordinates[set], sizeof vertex->texture_coordinates[0]);
    if (tangents)
        memcpy(key.values + 8, vertex->tangent, sizeof vertex->tangent);
    for (int i = 0; i < 12; i++)
        key.values[i] += 0.0f; // -0 equals 0, and must have its bits
    return key;
}

// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": a round of its
// mixing function for each number.
static size_t hash_of(const weld_key *key) {
    uint64_t hash = 0;
    for (int i = 0; i < 12; i++) {
        uint32_t bits;
        memcpy(&bits, &key->values[i], sizeof bits);
        hash = (hash ^ bits) * 0xbf58476d1ce4e5b9u;
        hash ^= hash >> 27;
    }
    return (size_t)hash;
}

static size_t table_size(size_t vertex_count) {
    size_t size = 1;
    while (size < 2 * vertex_count)
        size *= 2;
    return size;
}

bool scenes_mesh_weld(const lobe_allocator *allocator, const lobe_mesh *mesh, uint32_t set,
                      bool tangents, uint32_t *welded) {
    size_t size = table_size(mesh->vertex_count);
    uint32_t *table = lobe_allocate(allocator, size, sizeof *table); // a vertex plus one; 0: none
    for (size_t i = 0; table && i < mesh->vertex_count; i++) {
        weld_key key = key_of(&mesh->vertices[i], set, tangents);
        size_t slot = hash_of(&key) & (size - 1);
        for (; table[slot] != 0; slot = (slot + 1) & (size - 1)) {
            weld_key other = key_of(&mesh->vertices[table[slot] - 1], set, tangents);
            if (memcmp(&key, &other, sizeof key) == 0)
                break;
        }
        if (table[slot] == 0)
            table[slot] = (uint32_t)i + 1;
        welded[i] = table[slot] - 1;
    }
    lobe_release(table);
    return table != NULL;
}
