#ifndef TESTS_POSE_REFERENCE_H
#define TESTS_POSE_REFERENCE_H

#include <lobe/scene.h>

/// Deforms a vertex of a mesh by its pose, in double precision and by other formulas than the
/// device: as a mean of where each joint takes it, and with normals by solving M^T n' = n.
void pose_reference(const lobe_mesh *mesh, size_t vertex, lobe_scene_vertex *posed);

#endif
