#ifndef PASSES_UPLOAD_MESH_DENSITY_H
#define PASSES_UPLOAD_MESH_DENSITY_H

#include <lobe/scene.h>

/// How finely texture coordinates are laid out over a mesh: the least length of them (the root of
/// their area) to a metre (the root of the triangle's) in any triangle, for both sets.
typedef struct mesh_density {
    float least[2];
} mesh_density;

mesh_density passes_mesh_density_measure(const lobe_mesh *mesh);

#endif
