#ifndef TESTS_REFERENCE_MAP_NORMAL_MAP_H
#define TESTS_REFERENCE_MAP_NORMAL_MAP_H

#include <lobe/scene.h>

/// Unit normal of a normal map's texel (n + 1)/2 in double precision, x and y multiplied by
/// `scale`; (0, 0, 1) where it is not finite or of no length. See shaders/lib/map/normal_map.glsl.
void reference_decode_normal(const double texel[3], double scale, double normal[3]);
/// The same for any encoding.
void reference_decode_stored_normal(const double texel[3], double scale,
                                    lobe_normal_encoding encoding, double normal[3]);

#endif
