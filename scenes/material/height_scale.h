#ifndef SCENES_MATERIAL_HEIGHT_SCALE_H
#define SCENES_MATERIAL_HEIGHT_SCALE_H

#include <stdbool.h>

#include <lobe/image.h>

/// How deep a relief is that a height map and a normal map show alike: the height_scale of a
/// lobe_material at which the slopes of the heights have the mean square of those of the normals.
/// (Least squares would make it too flat: heights of eight bits are noisy.) Negative where the
/// heights are depths. Both maps are RGBA8_UNORM or RGBA16_UNORM and repeat; heights in red,
/// normals +Y. False where the extents differ, or where the two have little in common: their
/// slopes' correlation is below 0.2.
bool scenes_height_scale_find(const lobe_image *heights, const lobe_image *normals, float *scale);

#endif
