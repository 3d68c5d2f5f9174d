#include "scenes/mesh/target_parts.h"

#include <string.h>

#include <lobe/allocator.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/weld.h"

lobe_result scenes_target_parts_fail_memory(const target_parts *parts) {
    return lobe_host_fail(parts->host, LOBE_ERROR_OUT_OF_MEMORY,
                          "mesh '%s': out of memory for tangents of morph targets",
                          parts->mesh->name);
}

// ---------------------------------------------------------------------------------------------
// Lists

static uint32_t welded_at(const target_parts *parts, uint32_t corner) {
    return parts->welded[parts->mesh->indices[corner]];
}

// Lists the numbers of all items by their owners: of owner i, those from first[i] to before
// first[i + 1]. `first` has room for one number more than that, and is zeroed.
static void list_by_owner(const uint32_t *owners, size_t count, size_t owner_count, uint32_t *first,
                          uint32_t *list) {
    for (size_t i = 0; i < count; i++)
        first[owners[i] + 2]++;
    for (size_t i = 0; i < owner_count; i++)
        first[i + 2] += first[i + 1];
    for (size_t i = 0; i < count; i++)
        list[first[owners[i] + 1]++] = (uint32_t)i;
}

static void sort(target_parts *parts) {
    uint32_t *owners = parts->scratch;
    const lobe_mesh *mesh = parts->mesh;
    const lobe_deformation *deformation = mesh->deformation;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (uint32_t k = deformation->first_deltas[i]; k < deformation->first_deltas[i + 1]; k++)
            parts->vertices[k] = (uint32_t)i;
    for (size_t k = 0; k < deformation->delta_count; k++)
        owners[k] = deformation->deltas[k].target;
    list_by_owner(owners, deformation->delta_count, deformation->target_count, parts->first_deltas,
                  parts->deltas);
    for (uint32_t k = 0; k < mesh->index_count; k++)
        owners[k] = welded_at(parts, k);
    list_by_owner(owners, mesh->index_count, mesh->vertex_count, parts->first_corners,
                  parts->corners);
}

static bool allocate(target_parts *parts) {
    const lobe_allocator *allocator = lobe_host_allocator(parts->host);
    const size_t vertices = parts->mesh->vertex_count, corners = parts->mesh->index_count;
    const size_t deltas = parts->mesh->deformation->delta_count;
    const struct {
        uint32_t **array;
        size_t count;
    } arrays[] = {{&parts->first_deltas, parts->mesh->deformation->target_count + 2},
                  {&parts->deltas, deltas},
                  {&parts->vertices, deltas},
                  {&parts->welded, vertices},
                  {&parts->groups, vertices},
                  {&parts->first_corners, vertices + 2},
                  {&parts->corners, corners},
                  {&parts->moved, vertices},
                  {&parts->changed, vertices},
                  {&parts->shared, corners / 3},
                  {&parts->places, vertices},
                  {&parts->scratch, deltas + corners}};
    bool done = true;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        *arrays[i].array = lobe_allocate(allocator, arrays[i].count, sizeof **arrays[i].array);
        done = done && *arrays[i].array;
    }
    return done;
}

void scenes_target_parts_close(target_parts *parts) {
    void *const all[] = {parts->first_deltas, parts->deltas, parts->vertices,
                         parts->welded,       parts->groups, parts->first_corners,
                         parts->corners,      parts->moved,  parts->changed,
                         parts->shared,       parts->places, parts->scratch};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        lobe_release(all[i]);
}

lobe_result scenes_target_parts_open(target_parts *parts, lobe_mesh *mesh, uint32_t set,
                                     const lobe_host *host) {
    const lobe_allocator *allocator = lobe_host_allocator(host);
    *parts = (target_parts){.mesh = mesh, .host = host};
    if (!allocate(parts) || !scenes_mesh_weld(allocator, mesh, set, false, parts->welded) ||
        !scenes_mesh_weld(allocator, mesh, set, true, parts->groups))
        return scenes_target_parts_fail_memory(parts);
    sort(parts);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// One part

static bool moves(const lobe_morph_delta *delta) {
    bool any = false;
    for (int i = 0; i < 3; i++)
        any = any || delta->position[i] != 0 || delta->normal[i] != 0;
    return any;
}

// Appends the triangles around a welded vertex that are not yet in the part.
static void share_triangles(target_parts *parts, uint32_t vertex, uint32_t number,
                            target_part *part) {
    for (uint32_t i = parts->first_corners[vertex]; i < parts->first_corners[vertex + 1]; i++) {
        const uint32_t triangle = parts->corners[i] / 3;
        if (parts->shared[triangle] != number)
            part->triangles[part->triangle_count++] = triangle;
        parts->shared[triangle] = number;
    }
}

// All corners of a moved vertex's triangles turn, and so all triangles around these belong to it.
static void change_around(target_parts *parts, uint32_t vertex, uint32_t number,
                          target_part *part) {
    for (uint32_t i = parts->first_corners[vertex]; i < parts->first_corners[vertex + 1]; i++) {
        const uint32_t first = parts->corners[i] / 3 * 3;
        for (uint32_t k = first; k < first + 3; k++) {
            const uint32_t corner = welded_at(parts, k);
            if (parts->changed[corner] != number)
                share_triangles(parts, corner, number, part);
            parts->changed[corner] = number;
        }
    }
}

static void find_triangles(target_parts *parts, target_part *part) {
    const lobe_morph_delta *deltas = parts->mesh->deformation->deltas;
    const uint32_t number = part->target + 1;
    for (uint32_t i = parts->first_deltas[part->target]; i < parts->first_deltas[number]; i++) {
        const uint32_t vertex = parts->welded[parts->vertices[parts->deltas[i]]];
        if (moves(&deltas[parts->deltas[i]]) && parts->moved[vertex] != number)
            change_around(parts, vertex, number, part);
        if (moves(&deltas[parts->deltas[i]]))
            parts->moved[vertex] = number;
    }
}

static size_t place_vertices(target_parts *parts, target_part *part) {
    size_t count = 0;
    for (size_t i = 0; i < 3 * part->triangle_count; i++) {
        const uint32_t vertex = parts->mesh->indices[3 * part->triangles[i / 3] + i % 3];
        if (parts->places[vertex] == 0) {
            part->whole[count] = vertex;
            parts->places[vertex] = (uint32_t)++count;
        }
    }
    return count;
}

static void fill(const target_parts *parts, target_part *part) {
    const lobe_mesh *mesh = parts->mesh;
    for (size_t i = 0; i < part->mesh.vertex_count; i++) {
        part->mesh.vertices[i] = mesh->vertices[part->whole[i]];
        part->deltas[i] = NO_DELTA;
    }
    for (size_t i = 0; i < part->mesh.index_count; i++)
        part->mesh.indices[i] =
            parts->places[mesh->indices[3 * part->triangles[i / 3] + i % 3]] - 1;
    for (uint32_t i = parts->first_deltas[part->target]; i < parts->first_deltas[part->target + 1];
         i++) {
        const uint32_t place = parts->places[parts->vertices[parts->deltas[i]]];
        if (place > 0)
            part->deltas[place - 1] = parts->deltas[i];
    }
    memcpy(part->mesh.has_texture_coordinates, mesh->has_texture_coordinates,
           sizeof mesh->has_texture_coordinates);
}

lobe_result scenes_target_part_open(target_parts *parts, uint32_t target, target_part *part) {
    const lobe_allocator *allocator = lobe_host_allocator(parts->host);
    *part = (target_part){.target = target, .triangles = parts->scratch};
    find_triangles(parts, part);
    if (part->triangle_count == 0)
        return LOBE_OK;
    const size_t corners = 3 * part->triangle_count;
    part->whole = lobe_allocate(allocator, corners, sizeof *part->whole);
    part->deltas = lobe_allocate(allocator, corners, sizeof *part->deltas);
    if (!part->whole || !part->deltas)
        return scenes_target_parts_fail_memory(parts);
    const size_t count = place_vertices(parts, part);
    const lobe_result result =
        scenes_mesh_allocate(&part->mesh, parts->mesh->name, count, corners, parts->host);
    if (result == LOBE_OK)
        fill(parts, part);
    return result;
}

void scenes_target_part_close(target_parts *parts, target_part *part) {
    for (size_t i = 0; part->whole && i < 3 * part->triangle_count; i++)
        parts->places[parts->mesh->indices[3 * part->triangles[i / 3] + i % 3]] = 0;
    lobe_release(part->whole);
    lobe_release(part->deltas);
    scenes_mesh_free(&part->mesh);
}

bool scenes_target_part_turns(const target_parts *parts, const target_part *part, size_t i) {
    return parts->changed[parts->welded[part->whole[i]]] == part->target + 1;
}
