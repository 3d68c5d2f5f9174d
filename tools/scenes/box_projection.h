#ifndef TOOLS_SCENES_BOX_PROJECTION_H
#define TOOLS_SCENES_BOX_PROJECTION_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Texture coordinates for a mesh that has none, for maps that tile: each triangle is projected
/// along one of the six axes, the one that the surface around it faces. One unit of the first set
/// is `tile` metres in the plane of the projection, so a map's stretch on the surface is between 1
/// and 2. No map is mirrored. Vertices between triangles of different axes are split: maps do not
/// fit together there, as at the seams of clothing. The mesh must have normals; tangents are
/// computed. LOBE_ERROR_OUT_OF_MEMORY leaves the mesh unspecified, to be freed.
lobe_result box_projection_apply(lobe_mesh *mesh, double tile, const lobe_host *host);

#endif
