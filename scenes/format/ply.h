#ifndef SCENES_FORMAT_PLY_H
#define SCENES_FORMAT_PLY_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Reads a mesh in PLY (Turk 1994, "The PLY Polygon File Format"), ascii or binary_little_endian:
/// x, y, z of the element `vertex`, and the list vertex_indices (or vertex_index) of the element
/// `face`, whose polygons are cut into fans of triangles. Other properties and elements are passed
/// over. `name` is for messages. The mesh has smooth normals and no texture coordinates. On
/// failure it is empty. Errors: LOBE_ERROR_MALFORMED, LOBE_ERROR_UNSUPPORTED (another format),
/// LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_ply_read(const void *bytes, size_t size, const char *name, const lobe_host *host,
                            lobe_mesh *mesh);

#endif
