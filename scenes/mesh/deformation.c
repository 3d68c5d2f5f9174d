#include "scenes/mesh/deformation.h"

#include <string.h>

#include <lobe/allocator.h>

void scenes_deformation_free(lobe_deformation **deformation) {
    lobe_deformation *old = *deformation;
    *deformation = NULL;
    if (!old)
        return;
    lobe_release(old->first_deltas);
    lobe_release(old->deltas);
    lobe_release(old->weights);
    lobe_release(old->influences);
    lobe_release(old->joint_matrices);
    lobe_release(old);
}

static bool copy_influences(lobe_mesh *mesh, const uint32_t *origins, size_t count) {
    lobe_deformation *deformation = mesh->deformation;
    const size_t each = deformation->influences_per_vertex;
    if (each == 0)
        return true;
    lobe_joint_influence *influences = lobe_reallocate(
        NULL, deformation->influences, (mesh->vertex_count + count) * each, sizeof *influences);
    if (!influences)
        return false;
    deformation->influences = influences;
    for (size_t i = 0; i < count; i++)
        memcpy(influences + (mesh->vertex_count + i) * each, influences + origins[i] * each,
               each * sizeof *influences);
    return true;
}

static size_t count_deltas(const lobe_deformation *deformation, const uint32_t *origins,
                           size_t count) {
    size_t deltas = 0;
    for (size_t i = 0; i < count; i++)
        deltas += deformation->first_deltas[origins[i] + 1] - deformation->first_deltas[origins[i]];
    return deltas;
}

static bool grow_deltas(lobe_mesh *mesh, size_t count, size_t more) {
    lobe_deformation *deformation = mesh->deformation;
    if (deformation->delta_count + more > UINT32_MAX)
        return false;
    uint32_t *first = lobe_reallocate(NULL, deformation->first_deltas,
                                      mesh->vertex_count + count + 1, sizeof *first);
    if (!first)
        return false;
    deformation->first_deltas = first;
    lobe_morph_delta *deltas = lobe_reallocate(NULL, deformation->deltas,
                                               deformation->delta_count + more + 1, sizeof *deltas);
    if (!deltas)
        return false;
    deformation->deltas = deltas;
    return true;
}

static bool copy_deltas(lobe_mesh *mesh, const uint32_t *origins, size_t count) {
    lobe_deformation *deformation = mesh->deformation;
    if (deformation->target_count == 0)
        return true;
    if (!grow_deltas(mesh, count, count_deltas(deformation, origins, count)))
        return false;
    uint32_t *first = deformation->first_deltas + mesh->vertex_count;
    for (size_t i = 0; i < count; i++) {
        const uint32_t begin = deformation->first_deltas[origins[i]],
                       end = deformation->first_deltas[origins[i] + 1];
        memcpy(deformation->deltas + first[i], deformation->deltas + begin,
               (end - begin) * sizeof *deformation->deltas);
        first[i + 1] = first[i] + (end - begin);
        deformation->delta_count += end - begin;
    }
    return true;
}

bool scenes_deformation_copy_vertices(lobe_mesh *mesh, const uint32_t *origins, size_t count) {
    return !mesh->deformation ||
           (copy_influences(mesh, origins, count) && copy_deltas(mesh, origins, count));
}

// Copies the deltas of each vertex, and leaves room for those that are added behind them. The room
// of vertex i ends before ends[i + 1], which is at first how many are added.
static void spread_deltas(const lobe_mesh *mesh, lobe_morph_delta *deltas, uint32_t *ends,
                          uint32_t *next) {
    const lobe_deformation *deformation = mesh->deformation;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const uint32_t first = deformation->first_deltas[i];
        const uint32_t own = deformation->first_deltas[i + 1] - first;
        memcpy(deltas + ends[i], deformation->deltas + first, own * sizeof *deltas);
        next[i] = ends[i] + own;
        ends[i + 1] += next[i];
    }
}

bool scenes_deformation_add_deltas(lobe_mesh *mesh, const lobe_morph_delta *added,
                                   const uint32_t *vertices, size_t count,
                                   const lobe_allocator *allocator) {
    lobe_deformation *deformation = mesh->deformation;
    const size_t sum = deformation->delta_count + count;
    if (count == 0)
        return true;
    uint32_t *ends = lobe_allocate(allocator, mesh->vertex_count + 1, sizeof *ends);
    uint32_t *next = lobe_allocate(allocator, mesh->vertex_count, sizeof *next);
    lobe_morph_delta *deltas =
        sum <= UINT32_MAX ? lobe_allocate(allocator, sum, sizeof *deltas) : NULL;
    const bool done = ends && next && deltas;
    if (done) {
        for (size_t i = 0; i < count; i++)
            ends[vertices[i] + 1]++;
        spread_deltas(mesh, deltas, ends, next);
        for (size_t i = 0; i < count; i++)
            deltas[next[vertices[i]]++] = added[i];
        lobe_release(deformation->deltas);
        lobe_release(deformation->first_deltas);
        deformation->deltas = deltas;
        deformation->first_deltas = ends;
        deformation->delta_count = sum;
    } else {
        lobe_release(deltas);
        lobe_release(ends);
    }
    lobe_release(next);
    return done;
}
