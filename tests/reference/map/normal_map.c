#include "tests/reference/map/normal_map.h"

#include <math.h>

#include "tests/reference/vector.h"

void reference_decode_normal(const double texel[3], double scale, double normal[3]) {
    reference_decode_stored_normal(texel, scale, LOBE_NORMALS_UNSIGNED, normal);
}

void reference_decode_stored_normal(const double texel[3], double scale,
                                    lobe_normal_encoding encoding, double normal[3]) {
    const bool is_signed = encoding == LOBE_NORMALS_SIGNED || encoding == LOBE_NORMALS_SIGNED_XY;
    double stored[3], largest = 0;
    for (int i = 0; i < 3; i++)
        stored[i] = is_signed ? texel[i] : 2 * texel[i] - 1;
    if (encoding == LOBE_NORMALS_UNSIGNED_XY || encoding == LOBE_NORMALS_SIGNED_XY)
        stored[2] = sqrt(fmax(0, 1 - stored[0] * stored[0] - stored[1] * stored[1]));
    for (int i = 0; i < 3; i++) {
        normal[i] = stored[i] * (i < 2 ? scale : 1);
        largest = isfinite(normal[i]) ? fmax(largest, fabs(normal[i])) : INFINITY;
    }
    if (largest < 1e-6 || isinf(largest)) {
        normal[0] = normal[1] = 0;
        normal[2] = 1;
    }
    reference_normalise(normal);
}
