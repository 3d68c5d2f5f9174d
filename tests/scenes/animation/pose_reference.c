#include "tests/scenes/animation/pose_reference.h"

#include <math.h>
#include <string.h>

typedef struct point {
    double position[3], normal[3], tangent[3];
} point;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalise(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static point morph(const lobe_mesh *mesh, size_t vertex) {
    const lobe_deformation *d = mesh->deformation;
    point p;
    for (int i = 0; i < 3; i++) {
        p.position[i] = mesh->vertices[vertex].position[i];
        p.normal[i] = mesh->vertices[vertex].normal[i];
        p.tangent[i] = mesh->vertices[vertex].tangent[i];
    }
    const uint32_t *first = d->target_count > 0 ? d->first_deltas + vertex : NULL;
    for (uint32_t k = first ? first[0] : 0; first && k < first[1]; k++) {
        const double weight = d->weights[d->deltas[k].target];
        for (int i = 0; i < 3; i++) {
            p.position[i] += weight * d->deltas[k].position[i];
            p.normal[i] += weight * d->deltas[k].normal[i];
            p.tangent[i] += weight * d->deltas[k].tangent[i];
        }
    }
    normalise(p.normal);
    return p;
}

static void blend(const lobe_deformation *d, size_t vertex, double linear[3][3]) {
    memset(linear, 0, 9 * sizeof(double));
    for (uint32_t k = 0; k < d->influences_per_vertex; k++) {
        const lobe_joint_influence *influence =
            &d->influences[vertex * d->influences_per_vertex + k];
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++)
                linear[row][column] += (double)influence->weight *
                                       d->joint_matrices[influence->joint][4 * column + row];
    }
}

/// Cramer's rule. Returns the determinant.
static double solve_transposed(const double m[3][3], double n[3]) {
    // Rows of the transposed matrix are the columns of m.
    double columns[3][3], out[3], minor[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            columns[k][i] = m[i][k];
    cross(columns[1], columns[2], minor);
    const double determinant = dot(columns[0], minor);
    for (int i = 0; i < 3; i++)
        out[i] = 0;
    for (int k = 0; k < 3; k++) {
        cross(columns[(k + 1) % 3], columns[(k + 2) % 3], minor);
        for (int i = 0; i < 3; i++)
            out[i] += n[k] * minor[i] / determinant;
    }
    memcpy(n, out, sizeof out);
    return determinant;
}

static double skin(const lobe_mesh *mesh, size_t vertex, point *p) {
    const lobe_deformation *d = mesh->deformation;
    double position[3] = {0}, tangent[3] = {0}, linear[3][3];
    if (d->joint_count == 0)
        return 1;
    for (uint32_t k = 0; k < d->influences_per_vertex; k++) {
        const lobe_joint_influence *influence =
            &d->influences[vertex * d->influences_per_vertex + k];
        const float *m = d->joint_matrices[influence->joint];
        for (int row = 0; row < 3; row++)
            position[row] +=
                influence->weight * (m[row] * p->position[0] + m[4 + row] * p->position[1] +
                                     m[8 + row] * p->position[2] + m[12 + row]);
    }
    blend(d, vertex, linear);
    for (int row = 0; row < 3; row++)
        tangent[row] = dot(linear[row], p->tangent);
    memcpy(p->position, position, sizeof position);
    memcpy(p->tangent, tangent, sizeof tangent);
    const double determinant = solve_transposed(linear, p->normal);
    normalise(p->normal);
    return determinant;
}

static void find_facet(const lobe_mesh *mesh, size_t vertex, double normal[3]) {
    double edges[2][3];
    point corners[3];
    for (size_t i = 0; i < 3; i++) {
        corners[i] = morph(mesh, vertex / 3 * 3 + i);
        skin(mesh, vertex / 3 * 3 + i, &corners[i]);
    }
    for (int i = 0; i < 2; i++)
        for (int axis = 0; axis < 3; axis++)
            edges[i][axis] = corners[i + 1].position[axis] - corners[0].position[axis];
    cross(edges[0], edges[1], normal);
    normalise(normal);
}

void pose_reference(const lobe_mesh *mesh, size_t vertex, lobe_scene_vertex *posed) {
    point p = morph(mesh, vertex);
    const double determinant = skin(mesh, vertex, &p);
    if (mesh->deformation->flat)
        find_facet(mesh, vertex, p.normal);
    const double along = dot(p.tangent, p.normal);
    for (int i = 0; i < 3; i++)
        p.tangent[i] -= along * p.normal[i];
    normalise(p.tangent);
    *posed = mesh->vertices[vertex];
    for (int i = 0; i < 3; i++) {
        posed->position[i] = (float)p.position[i];
        posed->normal[i] = (float)p.normal[i];
        posed->tangent[i] = (float)p.tangent[i];
    }
    if (determinant < 0)
        posed->tangent[3] = -posed->tangent[3];
}
