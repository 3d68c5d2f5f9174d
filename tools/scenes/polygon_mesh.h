#ifndef TOOLS_SCENES_POLYGON_MESH_H
#define TOOLS_SCENES_POLYGON_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Positions and polygons as listed in a file, before they become a mesh. Initialise everything
/// except the allocator to zero; free it with polygon_mesh_free.
typedef struct polygon_mesh {
    const lobe_allocator *allocator;
    float (*positions)[3];
    size_t position_count;
    uint32_t *indices; ///< three per triangle
    size_t index_count;
} polygon_mesh;

/// False if memory runs out. Positions must be within the range of float.
bool polygon_mesh_add_position(polygon_mesh *polygons, const double position[3]);
bool polygon_mesh_add_triangle(polygon_mesh *polygons, uint32_t a, uint32_t b, uint32_t c);

/// Makes a mesh from them, with smooth normals and without texture coordinates; triangles without
/// area are dropped. `name` is the name of the file. On failure `mesh` is empty. Errors:
/// LOBE_ERROR_MALFORMED (no triangles, or an index without a position), _LIMIT, _OUT_OF_MEMORY.
lobe_result polygon_mesh_finish(const polygon_mesh *polygons, const char *name,
                                const lobe_host *host, lobe_mesh *mesh);

void polygon_mesh_free(polygon_mesh *polygons);

#endif
