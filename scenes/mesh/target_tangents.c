// Tangents of morph targets. Where a mesh has no tangents of its own, each target gets those of its
// shape (glTF 2.0, section 3.7.2.2), which are found like the mesh's (tangents.c). A delta leads to
// them in the length to which the target stretches the mesh along its tangent: sums of several
// targets, or parts of one, then point where they do where the surface around is deformed alike.

#include <math.h>
#include <string.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/tangents.h"
#include "scenes/mesh/vector.h"
#include "scenes/mesh/weld.h"

#define NO_DELTA UINT32_MAX

/// Deltas that do less are left out.
#define LEAST_TURN 1e-5

// What is known of all targets. Marks are the number of the target that set them last, plus one, so
// that a target takes no longer than what it changes.
typedef struct target_work {
    lobe_mesh *mesh;
    const lobe_texture_use *use;
    const lobe_host *host;
    uint32_t *first_deltas;            // of each target: the beginning of its numbers in the next
    uint32_t *deltas;                  // numbers of deltas, by targets
    uint32_t *vertices;                // of each delta
    uint32_t *welded;                  // of each vertex
    uint32_t *groups;                  // of each vertex, the first welded one of the same tangent
    uint32_t *first_corners, *corners; // of each welded vertex, in the same way
    uint32_t *moved, *changed;         // marks of welded vertices: by the target, or turned by it
    uint32_t *shared;                  // marks of triangles that have such a vertex
    uint32_t *places;                  // of each vertex, its vertex in the part, plus one; 0: none
    lobe_morph_delta *added;
    uint32_t *added_vertices;
    size_t added_count, room, most;
} target_work;

// The triangles that a target changes and those beside them, first at rest.
typedef struct target_part {
    lobe_mesh mesh;
    uint32_t *triangles; // of the whole mesh
    size_t triangle_count;
    uint32_t *whole;  // of each vertex, that of the whole mesh
    uint32_t *deltas; // of each vertex, or NO_DELTA
    double *lengths;  // along u around each vertex, at rest
} target_part;

static lobe_result out_of_memory(const target_work *work) {
    return lobe_host_fail(work->host, LOBE_ERROR_OUT_OF_MEMORY,
                          "mesh '%s': out of memory for tangents of morph targets",
                          work->mesh->name);
}

// ---------------------------------------------------------------------------------------------
// Parts

static bool moves(const lobe_morph_delta *delta) {
    bool any = false;
    for (int i = 0; i < 3; i++)
        any = any || delta->position[i] != 0 || delta->normal[i] != 0;
    return any;
}

static uint32_t welded_at(const target_work *work, uint32_t corner) {
    return work->welded[work->mesh->indices[corner]];
}

// Appends the triangles around a welded vertex that are not yet in the part.
static void share_triangles(target_work *work, uint32_t vertex, uint32_t number,
                            target_part *part) {
    for (uint32_t i = work->first_corners[vertex]; i < work->first_corners[vertex + 1]; i++) {
        const uint32_t triangle = work->corners[i] / 3;
        if (work->shared[triangle] != number)
            part->triangles[part->triangle_count++] = triangle;
        work->shared[triangle] = number;
    }
}

// All corners of a moved vertex's triangles turn, and so all triangles around these belong to it.
static void change_around(target_work *work, uint32_t vertex, uint32_t number, target_part *part) {
    for (uint32_t i = work->first_corners[vertex]; i < work->first_corners[vertex + 1]; i++) {
        const uint32_t first = work->corners[i] / 3 * 3;
        for (uint32_t k = first; k < first + 3; k++) {
            const uint32_t corner = welded_at(work, k);
            if (work->changed[corner] != number)
                share_triangles(work, corner, number, part);
            work->changed[corner] = number;
        }
    }
}

static void find_triangles(target_work *work, uint32_t target, target_part *part) {
    const lobe_morph_delta *deltas = work->mesh->deformation->deltas;
    const uint32_t number = target + 1;
    for (uint32_t i = work->first_deltas[target]; i < work->first_deltas[number]; i++) {
        const uint32_t vertex = work->welded[work->vertices[work->deltas[i]]];
        if (moves(&deltas[work->deltas[i]]) && work->moved[vertex] != number)
            change_around(work, vertex, number, part);
        if (moves(&deltas[work->deltas[i]]))
            work->moved[vertex] = number;
    }
}

static size_t place_vertices(target_work *work, target_part *part) {
    size_t count = 0;
    for (size_t i = 0; i < 3 * part->triangle_count; i++) {
        const uint32_t vertex = work->mesh->indices[3 * part->triangles[i / 3] + i % 3];
        if (work->places[vertex] == 0) {
            part->whole[count] = vertex;
            work->places[vertex] = (uint32_t)++count;
        }
    }
    return count;
}

static void fill_part(const target_work *work, uint32_t target, target_part *part) {
    const lobe_mesh *mesh = work->mesh;
    for (size_t i = 0; i < part->mesh.vertex_count; i++) {
        part->mesh.vertices[i] = mesh->vertices[part->whole[i]];
        part->deltas[i] = NO_DELTA;
    }
    for (size_t i = 0; i < part->mesh.index_count; i++)
        part->mesh.indices[i] = work->places[mesh->indices[3 * part->triangles[i / 3] + i % 3]] - 1;
    for (uint32_t i = work->first_deltas[target]; i < work->first_deltas[target + 1]; i++) {
        const uint32_t place = work->places[work->vertices[work->deltas[i]]];
        if (place > 0)
            part->deltas[place - 1] = work->deltas[i];
    }
    memcpy(part->mesh.has_texture_coordinates, mesh->has_texture_coordinates,
           sizeof mesh->has_texture_coordinates);
}

static lobe_result open_part(target_work *work, uint32_t target, target_part *part) {
    const lobe_allocator *allocator = lobe_host_allocator(work->host);
    const size_t corners = 3 * part->triangle_count;
    part->whole = lobe_allocate(allocator, corners, sizeof *part->whole);
    part->deltas = lobe_allocate(allocator, corners, sizeof *part->deltas);
    part->lengths = lobe_allocate(allocator, corners, sizeof *part->lengths);
    if (!part->whole || !part->deltas || !part->lengths)
        return out_of_memory(work);
    const size_t count = place_vertices(work, part);
    const lobe_result result =
        scenes_mesh_allocate(&part->mesh, work->mesh->name, count, corners, work->host);
    if (result == LOBE_OK)
        fill_part(work, target, part);
    return result;
}

static void close_part(target_work *work, target_part *part) {
    for (size_t i = 0; part->whole && i < 3 * part->triangle_count; i++)
        work->places[work->mesh->indices[3 * part->triangles[i / 3] + i % 3]] = 0;
    lobe_release(part->whole);
    lobe_release(part->deltas);
    lobe_release(part->lengths);
    scenes_mesh_free(&part->mesh);
}

// ---------------------------------------------------------------------------------------------
// The target's shape

// The vertex of the part that stands for all that share vertex `i`'s tangent at rest.
static uint32_t shared_in_part(const target_work *work, const target_part *part, uint32_t i) {
    const uint32_t place = work->places[work->groups[part->whole[i]]];
    return place > 0 ? place - 1 : i;
}

// Lengths along u around each vertex of the part. False: out of memory.
static bool measure_lengths(const target_work *work, const target_part *part, double *lengths) {
    const lobe_mesh *mesh = &part->mesh;
    vector3 *sums =
        lobe_allocate(lobe_host_allocator(work->host), mesh->vertex_count, sizeof *sums);
    for (uint32_t first = 0; sums && first + 2 < mesh->index_count; first += 3) {
        const triangle_mapping mapping = scenes_mesh_map_triangle(mesh, work->use, first);
        const vector3 along = vector3_scale(mapping.along, mapping.area < 0 ? -1 : 1);
        for (uint32_t k = first; mapping.area != 0 && k < first + 3; k++) {
            vector3 *sum = &sums[shared_in_part(work, part, mesh->indices[k])];
            *sum = vector3_add(*sum, along);
        }
    }
    for (uint32_t i = 0; sums && i < mesh->vertex_count; i++)
        lengths[i] = vector3_length(sums[shared_in_part(work, part, i)]);
    lobe_release(sums);
    return sums != NULL;
}

static void add(float sum[3], const float delta[3]) {
    for (int i = 0; i < 3; i++)
        sum[i] += delta[i];
}

static lobe_result deform_part(const target_work *work, target_part *part) {
    size_t repaired = 0;
    for (size_t i = 0; i < part->mesh.vertex_count; i++) {
        if (part->deltas[i] == NO_DELTA)
            continue;
        const lobe_morph_delta *delta = &work->mesh->deformation->deltas[part->deltas[i]];
        add(part->mesh.vertices[i].position, delta->position);
        add(part->mesh.vertices[i].normal, delta->normal);
    }
    return work->mesh->deformation->flat
               ? scenes_mesh_compute_normals(&part->mesh, work->host)
               : scenes_mesh_repair_normals(&part->mesh, work->host, &repaired);
}

static lobe_result append(target_work *work, uint32_t vertex, const lobe_morph_delta *delta) {
    if (work->added_count == work->most)
        return lobe_host_fail(work->host, LOBE_ERROR_LIMIT,
                              "mesh '%s': morph targets turn more than %zu vertices besides those "
                              "that they move",
                              work->mesh->name, work->most);
    if (work->added_count == work->room) {
        const lobe_allocator *allocator = lobe_host_allocator(work->host);
        const size_t more = work->room ? 2 * work->room : 64;
        lobe_morph_delta *added =
            lobe_reallocate(allocator, work->added, more, sizeof *work->added);
        work->added = added ? added : work->added;
        uint32_t *vertices =
            lobe_reallocate(allocator, work->added_vertices, more, sizeof *work->added_vertices);
        work->added_vertices = vertices ? vertices : work->added_vertices;
        if (!added || !vertices)
            return out_of_memory(work);
        work->room = more;
    }
    work->added[work->added_count] = *delta;
    work->added_vertices[work->added_count++] = vertex;
    return LOBE_OK;
}

// `stretch`: of the target's shape along its tangent.
static lobe_result turn_vertex(target_work *work, uint32_t target, uint32_t vertex, uint32_t number,
                               const float tangent[3], double stretch) {
    lobe_morph_delta fresh = {.target = target};
    lobe_morph_delta *delta =
        number == NO_DELTA ? &fresh : &work->mesh->deformation->deltas[number];
    const vector3 turn = vector3_subtract(vector3_scale(vector3_load(tangent), stretch),
                                          vector3_load(work->mesh->vertices[vertex].tangent));
    vector3_store(turn, delta->tangent);
    return number != NO_DELTA || vector3_length(turn) <= LEAST_TURN ? LOBE_OK
                                                                    : append(work, vertex, delta);
}

// Where a shape has no length along u, its tangent is any: the other's outweighs it in between.
static double stretch_between(double rest, double target) {
    const double stretch = target / rest;
    return isnan(stretch) ? 1 : fmin(fmax(stretch, 1e-3), 1e3);
}

// Vertices that splitting appends to the part are copies with other tangents.
static lobe_result turn_vertices(target_work *work, uint32_t target, const target_part *part,
                                 const double *lengths, size_t count) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < count; i++) {
        const uint32_t vertex = part->whole[i];
        if (work->changed[work->welded[vertex]] == target + 1)
            result =
                turn_vertex(work, target, vertex, part->deltas[i], part->mesh.vertices[i].tangent,
                            stretch_between(part->lengths[i], lengths[i]));
    }
    return result;
}

static lobe_result compute_part(target_work *work, uint32_t target, target_part *part) {
    const size_t count = part->mesh.vertex_count;
    double *lengths = lobe_allocate(lobe_host_allocator(work->host), count, sizeof *lengths);
    lobe_result result = lengths && measure_lengths(work, part, part->lengths)
                             ? deform_part(work, part)
                             : out_of_memory(work);
    if (result == LOBE_OK && !measure_lengths(work, part, lengths))
        result = out_of_memory(work);
    if (result == LOBE_OK)
        result = scenes_mesh_compute_tangents(&part->mesh, work->use, work->host);
    if (result == LOBE_OK)
        result = turn_vertices(work, target, part, lengths, count);
    lobe_release(lengths);
    return result;
}

static lobe_result compute_target(target_work *work, uint32_t target, uint32_t *triangles) {
    target_part part = {.triangles = triangles};
    find_triangles(work, target, &part);
    if (part.triangle_count == 0)
        return LOBE_OK;
    lobe_result result = open_part(work, target, &part);
    if (result == LOBE_OK)
        result = compute_part(work, target, &part);
    close_part(work, &part);
    return result;
}

// ---------------------------------------------------------------------------------------------
// All targets

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

// `owners`: room for one number for each delta and each corner.
static void sort(target_work *work, uint32_t *owners) {
    const lobe_mesh *mesh = work->mesh;
    const lobe_deformation *deformation = mesh->deformation;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (uint32_t k = deformation->first_deltas[i]; k < deformation->first_deltas[i + 1]; k++)
            work->vertices[k] = (uint32_t)i;
    for (size_t k = 0; k < deformation->delta_count; k++)
        owners[k] = deformation->deltas[k].target;
    list_by_owner(owners, deformation->delta_count, deformation->target_count, work->first_deltas,
                  work->deltas);
    for (uint32_t k = 0; k < mesh->index_count; k++)
        owners[k] = welded_at(work, k);
    list_by_owner(owners, mesh->index_count, mesh->vertex_count, work->first_corners,
                  work->corners);
}

static bool allocate(target_work *work) {
    const lobe_allocator *allocator = lobe_host_allocator(work->host);
    const size_t vertices = work->mesh->vertex_count, corners = work->mesh->index_count;
    const size_t deltas = work->mesh->deformation->delta_count;
    const struct {
        uint32_t **array;
        size_t count;
    } arrays[] = {{&work->first_deltas, work->mesh->deformation->target_count + 2},
                  {&work->deltas, deltas},
                  {&work->vertices, deltas},
                  {&work->welded, vertices},
                  {&work->groups, vertices},
                  {&work->first_corners, vertices + 2},
                  {&work->corners, corners},
                  {&work->moved, vertices},
                  {&work->changed, vertices},
                  {&work->shared, corners / 3},
                  {&work->places, vertices}};
    bool done = true;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        *arrays[i].array = lobe_allocate(allocator, arrays[i].count, sizeof **arrays[i].array);
        done = done && *arrays[i].array;
    }
    return done;
}

static void release(target_work *work) {
    void *const all[] = {work->first_deltas,  work->deltas,        work->vertices, work->welded,
                         work->groups,        work->first_corners, work->corners,  work->moved,
                         work->changed,       work->shared,        work->places,   work->added,
                         work->added_vertices};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        lobe_release(all[i]);
}

// Inserts the deltas that were added after those of the same vertex. False: out of memory.
static bool insert_added(target_work *work) {
    lobe_deformation *deformation = work->mesh->deformation;
    const size_t vertices = work->mesh->vertex_count;
    const size_t count = deformation->delta_count + work->added_count;
    if (work->added_count == 0)
        return true;
    const lobe_allocator *allocator = lobe_host_allocator(work->host);
    uint32_t *ends = lobe_allocate(allocator, vertices + 1, sizeof *ends);
    lobe_morph_delta *deltas =
        count <= UINT32_MAX ? lobe_allocate(allocator, count, sizeof *deltas) : NULL;
    if (!ends || !deltas) {
        lobe_release(ends);
        lobe_release(deltas);
        return false;
    }
    for (size_t i = 0; i < work->added_count; i++)
        ends[work->added_vertices[i] + 1]++;
    for (size_t i = 0; i < vertices; i++) {
        const uint32_t first = deformation->first_deltas[i];
        const uint32_t own = deformation->first_deltas[i + 1] - first, more = ends[i + 1];
        memcpy(deltas + ends[i], deformation->deltas + first, own * sizeof *deltas);
        // Where the next of its own that was added goes, until all are there.
        ends[i + 1] = ends[i] + own + more;
        work->places[i] = ends[i] + own;
    }
    for (size_t i = 0; i < work->added_count; i++)
        deltas[work->places[work->added_vertices[i]]++] = work->added[i];
    lobe_release(deformation->deltas);
    lobe_release(deformation->first_deltas);
    deformation->deltas = deltas;
    deformation->first_deltas = ends;
    deformation->delta_count = count;
    return true;
}

static lobe_result compute_targets(target_work *work) {
    const lobe_mesh *mesh = work->mesh;
    const lobe_deformation *deformation = mesh->deformation;
    const lobe_allocator *allocator = lobe_host_allocator(work->host);
    uint32_t *scratch =
        lobe_allocate(allocator, deformation->delta_count + mesh->index_count, sizeof *scratch);
    const uint32_t set = work->use->texture_coordinates;
    if (!scratch || !scenes_mesh_weld(allocator, mesh, set, false, work->welded) ||
        !scenes_mesh_weld(allocator, mesh, set, true, work->groups)) {
        lobe_release(scratch);
        return out_of_memory(work);
    }
    lobe_result result = LOBE_OK;
    sort(work, scratch);
    for (uint32_t i = 0; result == LOBE_OK && i < deformation->target_count; i++)
        result = compute_target(work, i, scratch);
    lobe_release(scratch);
    return result;
}

lobe_result scenes_mesh_compute_target_tangents(lobe_mesh *mesh, const lobe_texture_use *use,
                                                size_t most, const lobe_host *host) {
    target_work work = {.mesh = mesh, .use = use, .host = host, .most = most};
    if (!mesh->deformation || mesh->deformation->delta_count == 0 ||
        use->texture_coordinates >= 2 || !mesh->has_texture_coordinates[use->texture_coordinates])
        return LOBE_OK;
    // A file with broken tangents may have some for its targets: they belong to others than ours.
    for (size_t i = 0; i < mesh->deformation->delta_count; i++)
        memset(mesh->deformation->deltas[i].tangent, 0, sizeof mesh->deformation->deltas->tangent);
    lobe_result result = allocate(&work) ? compute_targets(&work) : out_of_memory(&work);
    if (result == LOBE_OK && !insert_added(&work))
        result = out_of_memory(&work);
    release(&work);
    return result;
}
