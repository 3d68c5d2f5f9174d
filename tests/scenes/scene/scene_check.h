#ifndef TESTS_SCENES_SCENE_SCENE_CHECK_H
#define TESTS_SCENES_SCENE_SCENE_CHECK_H

#include <stdint.h>

#include <lobe/scene.h>

/// Assertions that hold for every scene made by code.

/// Everything is finite, normals have unit length, tangents are orthonormal, indices are in range,
/// every triangle has an area and its front on the side of its normals, and texture coordinates and
/// tangents agree: the tangent along increasing u, the bitangent against increasing v.
void scene_check_mesh(const lobe_mesh *mesh);

/// Checks the meshes, the indices of instances, materials and images, lights, a camera, the bounds.
void scene_check(const lobe_scene *scene);

/// Every texel of an RGBA8_UNORM normal map has unit length, within the precision of eight bits,
/// and points above the surface. Returns the mean normal, and the mean and greatest tilt in
/// degrees.
typedef struct normal_statistics {
    double mean[3], mean_tilt, greatest_tilt;
} normal_statistics;
normal_statistics scene_check_normal_map(const lobe_image *image);

/// Hash over images and the positions, coordinates and triangles of meshes.
uint64_t scene_check_hash(const lobe_scene *scene);

/// Every byte of the images, vertices and indices, lights and the camera of two scenes is equal.
void scene_check_equal(const lobe_scene *a, const lobe_scene *b);

#endif
