#ifndef SCENES_BUILTIN_NORMAL_MAP_H
#define SCENES_BUILTIN_NORMAL_MAP_H

#include <stdint.h>

/// Stores a normal (any length above 0, z > 0) as an RGBA8_UNORM texel of a +Y normal map:
/// RGB = (n + 1) / 2 of the unit normal, x to the right and y up in the image, alpha 1.
void scenes_normal_map_store(uint8_t texel[4], double x, double y, double z);

/// The same for a height field with these derivatives, along the columns (to the right) and along
/// the rows (downwards), in the units of the height.
void scenes_normal_map_store_slope(uint8_t texel[4], double along_column, double along_row);

#endif
