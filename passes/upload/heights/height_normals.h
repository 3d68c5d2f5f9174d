#ifndef PASSES_UPLOAD_HEIGHTS_HEIGHT_NORMALS_H
#define PASSES_UPLOAD_HEIGHTS_HEIGHT_NORMALS_H

#include <lobe/scene.h>

/// The normals of a height map's surface, whose map is as wide in the world as u grows by 1, and
/// whose texels are square: at each texel those of the mean slope towards both neighbours
/// (LOBE_NORMALS_SIGNED_XY, RG16_SNORM). The map's own values are read between 0 and 1.
/// LOBE_ERROR_OUT_OF_MEMORY: one line says so.
lobe_result passes_height_normals_make(const lobe_scene_image *heights, const lobe_texture_use *use,
                                       float height_scale, const lobe_host *host,
                                       lobe_image *normals);

#endif
