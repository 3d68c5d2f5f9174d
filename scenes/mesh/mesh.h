#ifndef SCENES_MESH_H
#define SCENES_MESH_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Meshes: memory, and what can be computed from positions and triangles alone. Adding a mesh to a
/// scene is in scenes/scene/scene.h.

/// Allocates zeroed vertices (colours 1) and zeroed indices; `mesh` is overwritten, `name` is
/// copied. LOBE_ERROR_LIMIT if a count is 0 or above 2^31, or the number of indices is not a
/// multiple of 3.
lobe_result scenes_mesh_allocate(lobe_mesh *mesh, const char *name, size_t vertex_count,
                                 size_t index_count, const lobe_host *host);

/// Frees the name, vertices, indices and deformation and zeroes the structure. May be called
/// repeatedly.
void scenes_mesh_free(lobe_mesh *mesh);

/// Smooth normals: at each vertex the mean of its triangles' normals, weighted by area. A vertex
/// without triangles, or whose triangles cancel, gets +Y. Vertices are not welded: where positions
/// repeat, edges stay sharp.
lobe_result scenes_mesh_compute_normals(lobe_mesh *mesh, const lobe_host *host);

/// Recomputes, like scenes_mesh_compute_normals, only normals that are shorter than 1e-6 or not
/// finite, and normalises the others. `*repaired` counts the recomputed ones.
lobe_result scenes_mesh_repair_normals(lobe_mesh *mesh, const lobe_host *host, size_t *repaired);

/// Mikkelsen's tangents (MikkTSpace), as glTF 2.0 asks for: along increasing u, orthonormal to the
/// (unit) normals; w is such that the bitangent w * cross(normal, tangent) runs up the image,
/// against v, as +Y normal maps require. `use` states the set of coordinates and their transform
/// before the fetch, so that the x axis of a normal map is the tangent; NULL: the first set, not
/// transformed. Where coordinates are missing or degenerate: any direction orthogonal to the
/// normal, w = 1. A vertex whose triangles need several tangents is split, so vertices may be
/// appended. On failure the mesh is unchanged.
lobe_result scenes_mesh_compute_tangents(lobe_mesh *mesh, const lobe_texture_use *use,
                                         const lobe_host *host);

/// Gives each morph target of a mesh with such tangents those of its shape, as far as texture
/// coordinates direct them: sets the deltas' tangents, and adds deltas of vertices that only turn,
/// at most `most`; LOBE_ERROR_LIMIT if there are more. `use` as above.
lobe_result scenes_mesh_compute_target_tangents(lobe_mesh *mesh, const lobe_texture_use *use,
                                                size_t most, const lobe_host *host);

/// Smooth tangents of a mesh of our own, with one tangent and w = 1 at every vertex: the mean of
/// its triangles' tangents along increasing u of the first set, weighted by area. Vertices are
/// neither welded nor split. Not for maps that another program has baked.
lobe_result scenes_mesh_smooth_tangents(lobe_mesh *mesh, const lobe_host *host);

/// Any unit vector orthogonal to the unit vector `normal`.
void scenes_mesh_orthogonal(const float normal[3], float tangent[3]);

/// Drops triangles without area: those with two equal indices or with their corners on one line.
/// Returns their number.
size_t scenes_mesh_drop_degenerate(lobe_mesh *mesh);

/// Sets minimum and maximum from the positions.
void scenes_mesh_compute_bounds(lobe_mesh *mesh);

#endif
