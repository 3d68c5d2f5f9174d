#ifndef SCENES_MESH_TANGENTS_H
#define SCENES_MESH_TANGENTS_H

#include <stdint.h>

#include <lobe/scene.h>

#include "scenes/mesh/vector.h"

/// How a triangle's texture coordinates, transformed by their use, lie on it.
typedef struct triangle_mapping {
    vector3 along, down; ///< derivatives of the position by u and by v, each times `area`
    float area;          ///< twice that of the coordinates, with their sign
} triangle_mapping;

/// Of the triangle whose corners are indices[first] and the following two.
triangle_mapping scenes_mesh_map_triangle(const lobe_mesh *mesh, const lobe_texture_use *use,
                                          uint32_t first);

#endif
