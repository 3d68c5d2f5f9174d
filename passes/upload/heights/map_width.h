#ifndef PASSES_UPLOAD_HEIGHTS_MAP_WIDTH_H
#define PASSES_UPLOAD_HEIGHTS_MAP_WIDTH_H

#include <lobe/scene.h>

/// Length over which a map's u grows by 1 on a mesh at rest, the object's: the mean over its area,
/// without triangles that the map does not cover. 0: it covers none.
double passes_map_width(const lobe_mesh *mesh, const lobe_texture_use *use);

#endif
