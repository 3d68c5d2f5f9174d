#ifndef SCENES_FORMAT_JAVASCRIPT_MESH_H
#define SCENES_FORMAT_JAVASCRIPT_MESH_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Reads the mesh of a JavaScript module or JSON text that gives `positions`, an array of [x, y,
/// z], and `cells`, an array of [a, b, c] that count positions from 0; as members or as assignments
/// (`exports.cells = [...]`, `"cells": [...]`). Nothing is run, and what else there is is passed
/// over. `name` is for messages. The mesh has smooth normals and no texture coordinates. On
/// failure it is empty. Errors: LOBE_ERROR_MALFORMED, LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_javascript_mesh_read(const char *text, size_t size, const char *name,
                                        const lobe_host *host, lobe_mesh *mesh);

#endif
