// Tangents of morph targets. Where a mesh has no tangents of its own, each target gets those of its
// shape (glTF 2.0, section 3.7.2.2), which are found like the mesh's (tangents.c). A delta leads to
// them in the length to which the target stretches the mesh along its tangent: sums of several
// targets, or parts of one, then point where they do where the surface around is deformed alike.

#include <math.h>
#include <string.h>

#include <lobe/allocator.h>

#include "scenes/mesh/deformation.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/tangents.h"
#include "scenes/mesh/target_parts.h"
#include "scenes/mesh/vector.h"

/// Deltas that do less are left out.
#define LEAST_TURN 1e-5

typedef struct target_work {
    target_parts parts;
    const lobe_texture_use *use;
    lobe_morph_delta *added; // of vertices that only turn
    uint32_t *added_vertices;
    size_t added_count, room, most;
} target_work;

// ---------------------------------------------------------------------------------------------
// The target's shape

// The vertex of the part that stands for all that share vertex `i`'s tangent at rest.
static uint32_t shared_in_part(const target_work *work, const target_part *part, uint32_t i) {
    const uint32_t place = work->parts.places[work->parts.groups[part->whole[i]]];
    return place > 0 ? place - 1 : i;
}

// Lengths along u around each vertex of the part. False: out of memory.
static bool measure_lengths(const target_work *work, const target_part *part, double *lengths) {
    const lobe_mesh *mesh = &part->mesh;
    vector3 *sums =
        lobe_allocate(lobe_host_allocator(work->parts.host), mesh->vertex_count, sizeof *sums);
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
        const lobe_morph_delta *delta = &work->parts.mesh->deformation->deltas[part->deltas[i]];
        add(part->mesh.vertices[i].position, delta->position);
        add(part->mesh.vertices[i].normal, delta->normal);
    }
    return work->parts.mesh->deformation->flat
               ? scenes_mesh_compute_normals(&part->mesh, work->parts.host)
               : scenes_mesh_repair_normals(&part->mesh, work->parts.host, &repaired);
}

static lobe_result append(target_work *work, uint32_t vertex, const lobe_morph_delta *delta) {
    if (work->added_count == work->most)
        return lobe_host_fail(work->parts.host, LOBE_ERROR_LIMIT,
                              "mesh '%s': morph targets turn more than %zu vertices besides those "
                              "that they move",
                              work->parts.mesh->name, work->most);
    if (work->added_count == work->room) {
        const lobe_allocator *allocator = lobe_host_allocator(work->parts.host);
        const size_t more = work->room ? 2 * work->room : 64;
        lobe_morph_delta *added =
            lobe_reallocate(allocator, work->added, more, sizeof *work->added);
        work->added = added ? added : work->added;
        uint32_t *vertices =
            lobe_reallocate(allocator, work->added_vertices, more, sizeof *work->added_vertices);
        work->added_vertices = vertices ? vertices : work->added_vertices;
        if (!added || !vertices)
            return scenes_target_parts_fail_memory(&work->parts);
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
        number == NO_DELTA ? &fresh : &work->parts.mesh->deformation->deltas[number];
    const vector3 turn = vector3_subtract(vector3_scale(vector3_load(tangent), stretch),
                                          vector3_load(work->parts.mesh->vertices[vertex].tangent));
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
static lobe_result turn_vertices(target_work *work, const target_part *part, const double *rest,
                                 const double *deformed, size_t count) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < count; i++)
        if (scenes_target_part_turns(&work->parts, part, i))
            result =
                turn_vertex(work, part->target, part->whole[i], part->deltas[i],
                            part->mesh.vertices[i].tangent, stretch_between(rest[i], deformed[i]));
    return result;
}

static lobe_result compute_part(target_work *work, target_part *part) {
    const size_t count = part->mesh.vertex_count;
    const lobe_host *host = work->parts.host;
    double *rest = lobe_allocate(lobe_host_allocator(host), 2 * count, sizeof *rest);
    double *deformed = rest ? rest + count : NULL;
    lobe_result result = rest && measure_lengths(work, part, rest)
                             ? deform_part(work, part)
                             : scenes_target_parts_fail_memory(&work->parts);
    if (result == LOBE_OK && !measure_lengths(work, part, deformed))
        result = scenes_target_parts_fail_memory(&work->parts);
    if (result == LOBE_OK)
        result = scenes_mesh_compute_tangents(&part->mesh, work->use, host);
    if (result == LOBE_OK)
        result = turn_vertices(work, part, rest, deformed, count);
    lobe_release(rest);
    return result;
}

static lobe_result compute_target(target_work *work, uint32_t target) {
    target_part part;
    lobe_result result = scenes_target_part_open(&work->parts, target, &part);
    if (result == LOBE_OK && part.triangle_count > 0)
        result = compute_part(work, &part);
    scenes_target_part_close(&work->parts, &part);
    return result;
}

lobe_result scenes_mesh_compute_target_tangents(lobe_mesh *mesh, const lobe_texture_use *use,
                                                size_t most, const lobe_host *host) {
    target_work work = {.use = use, .most = most};
    const uint32_t set = use->texture_coordinates;
    lobe_deformation *deformation = mesh->deformation;
    if (!deformation || deformation->delta_count == 0 || set >= 2 ||
        !mesh->has_texture_coordinates[set])
        return LOBE_OK;
    // A file with broken tangents may have some for its targets: they belong to others than ours.
    for (size_t i = 0; i < deformation->delta_count; i++)
        memset(deformation->deltas[i].tangent, 0, sizeof deformation->deltas->tangent);
    lobe_result result = scenes_target_parts_open(&work.parts, mesh, set, host);
    for (uint32_t i = 0; result == LOBE_OK && i < deformation->target_count; i++)
        result = compute_target(&work, i);
    if (result == LOBE_OK &&
        !scenes_deformation_add_deltas(mesh, work.added, work.added_vertices, work.added_count,
                                       lobe_host_allocator(host)))
        result = scenes_target_parts_fail_memory(&work.parts);
    scenes_target_parts_close(&work.parts);
    lobe_release(work.added);
    lobe_release(work.added_vertices);
    return result;
}
