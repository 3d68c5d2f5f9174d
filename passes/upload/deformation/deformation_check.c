#include "passes/upload/deformation/deformation_check.h"

#include <math.h>
#include <stdio.h>

static lobe_result fail(const number_owner *owner, lobe_result result, const char *what) {
    return lobe_host_fail(owner->host, result, "%s: mesh '%s': its deformation %s", owner->where,
                          owner->name, what);
}

// ---------------------------------------------------------------------------------------------
// When it is uploaded

static lobe_result check_influences(const number_owner *owner, const lobe_mesh *mesh) {
    const lobe_deformation *deformation = mesh->deformation;
    const size_t count = deformation->influences_per_vertex;
    if (count > LOBE_MAXIMUM_INFLUENCES || deformation->joint_count > LOBE_MAXIMUM_JOINTS)
        return fail(owner, LOBE_ERROR_LIMIT, "has too many joints");
    if ((count > 0) != (deformation->joint_count > 0) || (count > 0 && !deformation->influences))
        return fail(owner, LOBE_ERROR_MALFORMED, "has joints without influences, or none of both");
    for (size_t i = 0; i < mesh->vertex_count * count; i++) {
        const lobe_joint_influence *influence = &deformation->influences[i];
        if (influence->joint >= deformation->joint_count)
            return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                                  "%s: mesh '%s': vertex %zu follows joint %u of %zu", owner->where,
                                  owner->name, i / count, influence->joint,
                                  deformation->joint_count);
        if (!(influence->weight >= 0 && influence->weight <= 1))
            return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                                  "%s: mesh '%s': vertex %zu has the joint weight %g; expected a "
                                  "number in [0, 1]",
                                  owner->where, owner->name, i / count, (double)influence->weight);
    }
    return LOBE_OK;
}

static bool is_finite(const lobe_morph_delta *delta) {
    float sum = 0;
    for (int i = 0; i < 3; i++)
        sum += 0 * delta->position[i] + 0 * delta->normal[i] + 0 * delta->tangent[i];
    return sum == 0;
}

static lobe_result check_deltas(const number_owner *owner, const lobe_mesh *mesh) {
    const lobe_deformation *deformation = mesh->deformation;
    if (deformation->target_count > LOBE_MAXIMUM_TARGETS)
        return fail(owner, LOBE_ERROR_LIMIT, "has too many morph targets");
    if (deformation->target_count == 0)
        return LOBE_OK;
    const uint32_t *first = deformation->first_deltas;
    if (!first || (deformation->delta_count > 0 && !deformation->deltas))
        return fail(owner, LOBE_ERROR_MALFORMED, "has morph targets, but no memory with them");
    for (size_t i = 0; i < mesh->vertex_count; i++)
        if (first[i] > first[i + 1] || first[i + 1] > deformation->delta_count ||
            first[i + 1] - first[i] > LOBE_MAXIMUM_TARGETS)
            return fail(owner, LOBE_ERROR_MALFORMED, "has deltas that are not in order");
    for (size_t i = 0; i < deformation->delta_count; i++)
        if (deformation->deltas[i].target >= deformation->target_count ||
            !is_finite(&deformation->deltas[i]))
            return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                                  "%s: mesh '%s': morph delta %zu is not finite, or of target %u "
                                  "of %zu",
                                  owner->where, owner->name, i, deformation->deltas[i].target,
                                  deformation->target_count);
    return LOBE_OK;
}

lobe_result passes_check_deformation(const number_owner *owner, const lobe_mesh *mesh) {
    if (!mesh->deformation)
        return LOBE_OK;
    if (mesh->deformation->flat && mesh->vertex_count % 3 != 0)
        return fail(owner, LOBE_ERROR_MALFORMED, "is flat, but of vertices that are no triangles");
    const lobe_result result = check_influences(owner, mesh);
    return result == LOBE_OK ? check_deltas(owner, mesh) : result;
}

// ---------------------------------------------------------------------------------------------
// In every frame

static bool is_affine(const float m[16]) {
    return m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1;
}

static lobe_result check_joints(const number_owner *owner, const lobe_deformation *deformation) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < deformation->joint_count; i++) {
        const float *m = deformation->joint_matrices[i];
        float sum = 0;
        for (int k = 0; k < 16; k++)
            sum += 0 * m[k];
        if (sum == 0 && is_affine(m))
            continue;
        char name[64];
        snprintf(name, sizeof name, "joint_matrices[%zu]", i);
        result = passes_check_numbers(owner, name, m, 16, -INFINITY, INFINITY);
        if (result == LOBE_OK)
            result = lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED,
                                    "%s: mesh '%s': the last row of %s is not (0, 0, 0, 1)",
                                    owner->where, owner->name, name);
    }
    return result;
}

static lobe_result check_pose(const number_owner *owner, const lobe_deformation *deformation) {
    if ((deformation->joint_count > 0 && !deformation->joint_matrices) ||
        (deformation->target_count > 0 && !deformation->weights))
        return fail(owner, LOBE_ERROR_MALFORMED, "has no memory with its pose");
    lobe_result result = check_joints(owner, deformation);
    return result == LOBE_OK && deformation->target_count > 0
               ? passes_check_numbers(owner, "weights", deformation->weights,
                                      deformation->target_count, -INFINITY, INFINITY)
               : result;
}

lobe_result passes_check_poses(const lobe_scene *scene, const lobe_host *host) {
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < scene->mesh_count; i++) {
        const number_owner owner = {
            .host = host, .where = scene->name, .kind = "mesh", .name = scene->meshes[i].name};
        if (scene->meshes[i].deformation)
            result = check_pose(&owner, scene->meshes[i].deformation);
    }
    return result;
}
