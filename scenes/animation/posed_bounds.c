#include "scenes/animation/posed_bounds.h"

#include <math.h>
#include <string.h>

static const lobe_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void include_point(lobe_box *box, const float point[3]) {
    for (int axis = 0; axis < 3; axis++) {
        box->minimum[axis] = fminf(box->minimum[axis], point[axis]);
        box->maximum[axis] = fmaxf(box->maximum[axis], point[axis]);
    }
}

static bool is_empty(const lobe_box *box) {
    return box->minimum[0] > box->maximum[0];
}

// ---------------------------------------------------------------------------------------------
// At rest

static lobe_box *allocate_boxes(size_t count, const lobe_host *host) {
    lobe_box *boxes = lobe_allocate(lobe_host_allocator(host), count, sizeof *boxes);
    for (size_t i = 0; boxes && i < count; i++)
        boxes[i] = nothing;
    return boxes;
}

static void measure_joints(const lobe_mesh *mesh, lobe_box *boxes) {
    const lobe_deformation *deformation = mesh->deformation;
    const uint32_t count = deformation->influences_per_vertex;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (uint32_t k = 0; k < count; k++) {
            const lobe_joint_influence *influence = &deformation->influences[i * count + k];
            if (influence->weight != 0)
                include_point(&boxes[influence->joint], mesh->vertices[i].position);
        }
    }
}

static void measure_targets(const lobe_deformation *deformation, lobe_box *boxes) {
    // A vertex that a target does not move stays.
    memset(boxes, 0, deformation->target_count * sizeof *boxes);
    for (size_t i = 0; i < deformation->delta_count; i++)
        include_point(&boxes[deformation->deltas[i].target], deformation->deltas[i].position);
}

lobe_result scenes_posed_bounds_measure(const lobe_mesh *mesh, lobe_posed_mesh *posed,
                                        const lobe_host *host) {
    const lobe_deformation *deformation = mesh->deformation;
    posed->bounds = nothing;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        include_point(&posed->bounds, mesh->vertices[i].position);
    if (deformation->joint_count > 0)
        posed->joint_bounds = allocate_boxes(deformation->joint_count, host);
    if (deformation->target_count > 0)
        posed->target_bounds = allocate_boxes(deformation->target_count, host);
    if ((deformation->joint_count > 0 && !posed->joint_bounds) ||
        (deformation->target_count > 0 && !posed->target_bounds))
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "mesh '%s': out of memory",
                              mesh->name);
    if (posed->joint_bounds)
        measure_joints(mesh, posed->joint_bounds);
    if (posed->target_bounds)
        measure_targets(deformation, posed->target_bounds);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// In a pose

/// How far targets move vertices at most, to both sides.
static void sum_targets(const lobe_posed_mesh *posed, const lobe_deformation *deformation,
                        double low[3], double high[3]) {
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = high[axis] = 0;
        for (size_t i = 0; i < deformation->target_count; i++) {
            const double weight = deformation->weights[i];
            const double a = weight * posed->target_bounds[i].minimum[axis],
                         b = weight * posed->target_bounds[i].maximum[axis];
            low[axis] += fmin(a, b);
            high[axis] += fmax(a, b);
        }
    }
}

/// Includes a box, widened and transformed. `m`: NULL: the identity.
static void include_box(const lobe_box *box, const double low[3], const double high[3],
                        const float *m, lobe_box *bounds) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const float *matrix = m ? m : identity;
    for (int row = 0; row < 3; row++) {
        double least = matrix[12 + row], most = least;
        for (int column = 0; column < 3; column++) {
            const double a = matrix[4 * column + row] * (box->minimum[column] + low[column]),
                         b = matrix[4 * column + row] * (box->maximum[column] + high[column]);
            least += fmin(a, b);
            most += fmax(a, b);
        }
        bounds->minimum[row] = fminf(bounds->minimum[row], (float)least);
        bounds->maximum[row] = fmaxf(bounds->maximum[row], (float)most);
    }
}

void scenes_posed_bounds_set(const lobe_posed_mesh *posed, lobe_mesh *mesh) {
    const lobe_deformation *deformation = mesh->deformation;
    const bool skinned = deformation->joint_count > 0;
    if ((skinned && !posed->joint_bounds) || (deformation->target_count && !posed->target_bounds))
        return;
    double low[3], high[3];
    lobe_box bounds = nothing;
    sum_targets(posed, deformation, low, high);
    for (size_t i = 0; skinned && i < deformation->joint_count; i++)
        if (!is_empty(&posed->joint_bounds[i]))
            include_box(&posed->joint_bounds[i], low, high, deformation->joint_matrices[i],
                        &bounds);
    if (!skinned)
        include_box(&posed->bounds, low, high, NULL, &bounds);
    if (is_empty(&bounds))
        return;
    memcpy(mesh->minimum, bounds.minimum, sizeof bounds.minimum);
    memcpy(mesh->maximum, bounds.maximum, sizeof bounds.maximum);
}
