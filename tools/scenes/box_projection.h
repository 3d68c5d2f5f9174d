#ifndef TOOLS_SCENES_BOX_PROJECTION_H
#define TOOLS_SCENES_BOX_PROJECTION_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Texture coordinates, for maps that tile, for a mesh that has none: each triangle is projected
/// along one of the six axes, the one that the surface around it faces. One unit of the first set
/// is `tile` metres in the plane of projection, so that maps are stretched 1 to 2 times on the
/// surface. Maps are not mirrored. Vertices between triangles of different axes are split: maps do
/// not match there, as at the seams of clothing. The mesh must have normals; tangents are computed.
/// LOBE_ERROR_OUT_OF_MEMORY leaves the mesh unspecified; free it.
lobe_result box_projection_apply(lobe_mesh *mesh, double tile, const lobe_host *host);

#endif
