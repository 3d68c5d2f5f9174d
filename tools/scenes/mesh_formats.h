#ifndef TOOLS_SCENES_MESH_FORMATS_H
#define TOOLS_SCENES_MESH_FORMATS_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Readers of files that hold one mesh. `name` is for messages. The mesh has smooth normals and no
/// texture coordinates; on failure it is empty. Errors: LOBE_ERROR_MALFORMED, LOBE_ERROR_LIMIT,
/// LOBE_ERROR_OUT_OF_MEMORY, and for PLY LOBE_ERROR_UNSUPPORTED (another format).

/// Reads PLY (Turk 1994, "The PLY Polygon File Format"), ascii or binary_little_endian: x, y, z of
/// the element `vertex`, and the list vertex_indices (or vertex_index) of the element `face`, whose
/// polygons are cut into fans of triangles. Other properties and elements are skipped.
lobe_result ply_read(const void *bytes, size_t size, const char *name, const lobe_host *host,
                     lobe_mesh *mesh);

/// Reads a JavaScript module or JSON text that gives `positions`, an array of [x, y, z], and
/// `cells`, an array of [a, b, c] that index positions from 0; as members or as assignments
/// (`exports.cells = [...]`, `"cells": [...]`). No code is run, and anything else is skipped.
lobe_result javascript_mesh_read(const char *text, size_t size, const char *name,
                                 const lobe_host *host, lobe_mesh *mesh);

#endif
