#ifndef SCENES_MATERIAL_HEIGHT_SCALE_H
#define SCENES_MATERIAL_HEIGHT_SCALE_H

#include <stdbool.h>

#include <lobe/image.h>

/// The depth of a relief that is given both as a height map and as a normal map: the height_scale
/// of a lobe_material at which the slopes of the heights have the same mean square as those of the
/// normals. (Least squares would make it too flat, because 8-bit heights are noisy.) Negative if
/// the heights are depths. Both maps are RGBA8_UNORM or RGBA16_UNORM and repeat; heights are in
/// red, normals are +Y. False if the extents differ, or if the two have little in common: their
/// slopes' correlation is below 0.2.
bool scenes_height_scale_find(const lobe_image *heights, const lobe_image *normals, float *scale);

#endif
