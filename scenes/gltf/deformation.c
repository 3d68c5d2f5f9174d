#include "scenes/gltf/attributes.h"

#include <math.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------
// Joints

typedef struct vertex_influences {
    lobe_joint_influence list[LOBE_MAXIMUM_INFLUENCES];
    uint32_t count;
    double sum;
} vertex_influences;

static lobe_result add_influence(const gltf_import *import, const gltf_attributes *attributes,
                                 size_t element, float joint, float weight, size_t joint_count,
                                 vertex_influences *influences) {
    if (!(weight >= 0) || !(weight <= 1e18f))
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: vertex %zu has the joint weight %g", import->path,
                              attributes->name, element, (double)weight);
    if (weight == 0)
        return LOBE_OK;
    if (!(joint < (float)joint_count))
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s: vertex %zu follows joint %.0f of a skin of %zu",
                              import->path, attributes->name, element, (double)joint, joint_count);
    influences->list[influences->count++] = (lobe_joint_influence){(uint32_t)joint, weight};
    influences->sum += weight;
    return LOBE_OK;
}

static lobe_result read_influences(const gltf_import *import, const gltf_attributes *attributes,
                                   size_t element, size_t joint_count,
                                   vertex_influences *influences) {
    lobe_result result = LOBE_OK;
    *influences = (vertex_influences){0};
    for (int set = 0; set < 2 && attributes->present[GLTF_JOINTS_0 + set]; set++) {
        float joints[4], weights[4];
        scenes_gltf_read_floats(&attributes->elements[GLTF_JOINTS_0 + set], element, joints);
        scenes_gltf_read_floats(&attributes->elements[GLTF_WEIGHTS_0 + set], element, weights);
        for (int i = 0; result == LOBE_OK && i < 4; i++)
            result = add_influence(import, attributes, element, joints[i], weights[i], joint_count,
                                   influences);
    }
    return result;
}

/// glTF 2.0, section 3.7.3.3. Sums of weights of 8 bits are off by less than the tolerance.
static void normalise(gltf_import *import, vertex_influences *influences) {
    if (influences->count == 0) {
        influences->list[0] = (lobe_joint_influence){0, 1};
        influences->count = 1;
        import->notes.unbound_vertices++;
        return;
    }
    import->notes.unit_weights += fabs(influences->sum - 1) > 0.02;
    for (uint32_t i = 0; i < influences->count; i++)
        influences->list[i].weight = (float)(influences->list[i].weight / influences->sum);
}

/// Leaves as many influences for each vertex as the one with the most has.
static void pack(lobe_deformation *deformation, size_t vertex_count, uint32_t most) {
    lobe_joint_influence *all = deformation->influences;
    for (size_t i = 0; i < vertex_count; i++)
        memmove(all + i * most, all + i * deformation->influences_per_vertex, most * sizeof *all);
    deformation->influences_per_vertex = most;
}

static lobe_result check_sets(gltf_import *import, const gltf_attributes *attributes,
                              const gltf_primitive *primitive) {
    const bool *present = attributes->present;
    if (primitive->has_more_joints)
        scenes_gltf_note_unsupported(import, "more than 8 joints per vertex");
    for (int set = 0; set < 2; set++)
        if (present[GLTF_JOINTS_0 + set] != present[GLTF_WEIGHTS_0 + set] ||
            (set > 0 && present[GLTF_JOINTS_1] && !present[GLTF_JOINTS_0]))
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: %s: JOINTS_%d and WEIGHTS_%d belong together", import->path,
                                  attributes->name, set, set);
    return LOBE_OK;
}

static lobe_result read_skin(gltf_import *import, const gltf_attributes *attributes,
                             const uint32_t *source, size_t joint_count, lobe_mesh *mesh) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    lobe_deformation *deformation = mesh->deformation;
    const uint32_t room = attributes->present[GLTF_JOINTS_1] ? 8 : 4;
    uint32_t most = 1;
    deformation->influences_per_vertex = room;
    deformation->joint_count = joint_count;
    deformation->influences =
        lobe_allocate(allocator, mesh->vertex_count, room * sizeof *deformation->influences);
    deformation->joint_matrices =
        lobe_allocate(allocator, joint_count, sizeof *deformation->joint_matrices);
    if (!deformation->influences || !deformation->joint_matrices)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: %s: out of memory",
                              import->path, attributes->name);
    for (size_t i = 0; i < joint_count; i++)
        for (int k = 0; k < 4; k++)
            deformation->joint_matrices[i][5 * k] = 1;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        vertex_influences influences;
        const lobe_result result =
            read_influences(import, attributes, source ? source[i] : i, joint_count, &influences);
        if (result != LOBE_OK)
            return result;
        normalise(import, &influences);
        memcpy(deformation->influences + i * room, influences.list,
               influences.count * sizeof *influences.list);
        most = influences.count > most ? influences.count : most;
    }
    pack(deformation, mesh->vertex_count, most);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Morph targets

/// The elements of a target; of those that it lacks, the count is 0.
typedef struct target_elements {
    gltf_elements position, normal, tangent;
} target_elements;

// What the mesh does not have itself is found from its shape, and so is what targets do to it (glTF
// 2.0, section 3.7.2.2).
static lobe_result open_target(const gltf_import *import, const gltf_attributes *attributes,
                               const gltf_target *target, size_t index, target_elements *elements) {
    lobe_result result = LOBE_OK;
    *elements = (target_elements){0};
    if (target->position >= 0)
        result = scenes_gltf_open_target(import, attributes, GLTF_POSITION, target->position, index,
                                         &elements->position);
    if (result == LOBE_OK && target->normal >= 0)
        result = scenes_gltf_open_target(import, attributes, GLTF_NORMAL, target->normal, index,
                                         &elements->normal);
    if (result == LOBE_OK && target->tangent >= 0)
        result = scenes_gltf_open_target(import, attributes, GLTF_TANGENT, target->tangent, index,
                                         &elements->tangent);
    if (!attributes->present[GLTF_NORMAL])
        elements->normal.count = 0;
    if (!attributes->present[GLTF_NORMAL] || !attributes->present[GLTF_TANGENT])
        elements->tangent.count = 0;
    return result;
}

static bool read_part(const gltf_elements *elements, size_t element, float out[3], bool *finite) {
    float values[4] = {0};
    if (elements->count > 0)
        scenes_gltf_read_floats(elements, element, values);
    memcpy(out, values, 3 * sizeof *out);
    *finite = *finite && fabsf(values[0]) <= 1e18f && fabsf(values[1]) <= 1e18f &&
              fabsf(values[2]) <= 1e18f;
    return values[0] != 0 || values[1] != 0 || values[2] != 0;
}

/// What a target does to an element. `*moves`: anything at all.
static lobe_result read_delta(const gltf_import *import, const gltf_attributes *attributes,
                              const target_elements *elements, uint32_t target, size_t element,
                              lobe_morph_delta *delta, bool *moves) {
    bool finite = true;
    delta->target = target;
    *moves = read_part(&elements->position, element, delta->position, &finite);
    *moves |= read_part(&elements->normal, element, delta->normal, &finite);
    *moves |= read_part(&elements->tangent, element, delta->tangent, &finite);
    if (finite)
        return LOBE_OK;
    return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                          "%s: %s: vertex %zu of morph target %u is out of range", import->path,
                          attributes->name, element, target);
}

static lobe_result append_delta(gltf_import *import, const gltf_attributes *attributes,
                                lobe_deformation *deformation, size_t *room,
                                const lobe_morph_delta *delta) {
    if (import->deltas >= GLTF_MAXIMUM_DELTAS)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                              "%s: %s: morph targets move more than %zu vertices", import->path,
                              attributes->name, GLTF_MAXIMUM_DELTAS);
    if (deformation->delta_count == *room) {
        const size_t more = *room ? 2 * *room : 64;
        lobe_morph_delta *deltas = lobe_reallocate(lobe_host_allocator(import->host),
                                                   deformation->deltas, more, sizeof *deltas);
        if (!deltas)
            return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: %s: out of memory",
                                  import->path, attributes->name);
        deformation->deltas = deltas;
        *room = more;
    }
    deformation->deltas[deformation->delta_count++] = *delta;
    import->deltas++;
    return LOBE_OK;
}

/// All deltas, vertex by vertex.
static lobe_result read_deltas(gltf_import *import, const gltf_attributes *attributes,
                               const target_elements *targets, const uint32_t *source,
                               lobe_mesh *mesh) {
    lobe_deformation *deformation = mesh->deformation;
    lobe_result result = LOBE_OK;
    size_t room = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (uint32_t k = 0; result == LOBE_OK && k < deformation->target_count; k++) {
            lobe_morph_delta delta;
            bool moves = false;
            result = read_delta(import, attributes, &targets[k], k, source ? source[i] : i, &delta,
                                &moves);
            if (result == LOBE_OK && moves)
                result = append_delta(import, attributes, deformation, &room, &delta);
        }
        if (result != LOBE_OK)
            return result;
        deformation->first_deltas[i + 1] = (uint32_t)deformation->delta_count;
    }
    return LOBE_OK;
}

static lobe_result read_targets(gltf_import *import, const gltf_attributes *attributes,
                                const gltf_primitive *primitive, const uint32_t *source,
                                lobe_mesh *mesh) {
    const lobe_allocator *allocator = lobe_host_allocator(import->host);
    const size_t count = primitive->target_count;
    lobe_deformation *deformation = mesh->deformation;
    target_elements *targets = lobe_allocate(allocator, count, sizeof *targets);
    deformation->target_count = count;
    deformation->first_deltas =
        lobe_allocate(allocator, mesh->vertex_count + 1, sizeof *deformation->first_deltas);
    deformation->weights = lobe_allocate(allocator, count, sizeof *deformation->weights);
    lobe_result result = LOBE_OK;
    if (!targets || !deformation->first_deltas || !deformation->weights)
        result = lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: %s: out of memory",
                                import->path, attributes->name);
    for (size_t i = 0; result == LOBE_OK && i < count; i++) {
        if (primitive->targets[i].has_others)
            scenes_gltf_note_unsupported(import, "morph targets of colours or coordinates");
        result = open_target(import, attributes, &primitive->targets[i], i, &targets[i]);
    }
    if (result == LOBE_OK)
        result = read_deltas(import, attributes, targets, source, mesh);
    lobe_release(targets);
    return result;
}

// ---------------------------------------------------------------------------------------------

lobe_result scenes_gltf_read_deformation(gltf_import *import, const gltf_attributes *attributes,
                                         const gltf_primitive *primitive, const uint32_t *source,
                                         size_t joint_count, lobe_mesh *mesh) {
    lobe_result result = check_sets(import, attributes, primitive);
    if (result != LOBE_OK)
        return result;
    mesh->deformation =
        lobe_allocate(lobe_host_allocator(import->host), 1, sizeof *mesh->deformation);
    if (!mesh->deformation)
        return lobe_host_fail(import->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: %s: out of memory",
                              import->path, attributes->name);
    mesh->deformation->flat = !attributes->present[GLTF_NORMAL];
    if (joint_count > 0)
        result = read_skin(import, attributes, source, joint_count, mesh);
    if (result == LOBE_OK && primitive->target_count > 0)
        result = read_targets(import, attributes, primitive, source, mesh);
    return result;
}

/// Others are not drawn.
static bool is_surface(const gltf_primitive *primitive) {
    return primitive->mode >= GLTF_TRIANGLES && primitive->mode <= GLTF_TRIANGLE_FAN;
}

lobe_result scenes_gltf_count_targets(const gltf_import *import, size_t mesh, size_t *count) {
    const gltf_mesh *m = &import->document->meshes[mesh];
    const gltf_primitive *first = NULL;
    *count = 0;
    for (size_t i = 0; i < m->primitive_count; i++) {
        if (!is_surface(&m->primitives[i]))
            continue;
        first = first ? first : &m->primitives[i];
        *count = first->target_count;
        if (m->primitives[i].target_count != *count)
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: mesh %zu: its primitives have %zu and %zu morph targets",
                                  import->path, mesh, *count, m->primitives[i].target_count);
    }
    if (*count > LOBE_MAXIMUM_TARGETS)
        return lobe_host_fail(import->host, LOBE_ERROR_LIMIT,
                              "%s: mesh %zu: %zu morph targets, at most %d", import->path, mesh,
                              *count, LOBE_MAXIMUM_TARGETS);
    return LOBE_OK;
}

lobe_result scenes_gltf_read_weights(const gltf_import *import, size_t mesh, int64_t node,
                                     size_t count, float *weights) {
    const gltf_mesh *m = &import->document->meshes[mesh];
    const gltf_node *n = node >= 0 ? &import->document->nodes[node] : NULL;
    const bool own = n && n->weight_count > 0;
    const double *from = own ? n->weights : m->weights;
    const size_t given = own ? n->weight_count : m->weight_count;
    if (given > 0 && given != count)
        return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                              "%s: %s %zu: %zu weights for %zu morph targets", import->path,
                              own ? "node" : "mesh", own ? (size_t)node : mesh, given, count);
    for (size_t i = 0; i < count; i++) {
        weights[i] = given > 0 ? (float)from[i] : 0;
        if (!(fabsf(weights[i]) <= 1e18f))
            return lobe_host_fail(import->host, LOBE_ERROR_MALFORMED,
                                  "%s: %s %zu: morph weight %zu is out of range", import->path,
                                  own ? "node" : "mesh", own ? (size_t)node : mesh, i);
    }
    return LOBE_OK;
}
