#ifndef LIB_LATITUDE_LONGITUDE_GLSL
#define LIB_LATITUDE_LONGITUDE_GLSL

#include "lib/number/constants.glsl"
#include "lib/light/cube_texel.glsl"

// atan(y, x) in (-pi, pi], to a few units in the last place; a driver's own may be off by thousands
// (Vulkan 1.3, "Precision and Operation of SPIR-V Instructions"). 0 at the origin.
float arctangent_of_quotient(float y, float x) {
    float larger = max(abs(x), abs(y));
    float tangent = larger > 0.0 ? min(abs(x), abs(y)) / larger : 0.0;
    // tan(a/2) = tan a / (1 + sqrt(1 + tan^2 a)) brings [0, 1] to [0, sqrt(2) - 1].
    float angle = 2.0 * arctangent_of_small(tangent / (1.0 + sqrt(1.0 + tangent * tangent)));
    if (abs(y) > abs(x))
        angle = 0.5 * PI - angle;
    if (x < 0.0)
        angle = PI - angle;
    return y < 0.0 ? -angle : angle;
}

// Where a direction lies on an image of latitude and longitude, both in [0, 1]: the top is +Y, the
// centre +Z, and x = 1/4 is +X. Any length but 0.
vec2 latitude_longitude(vec3 direction) {
    float longitude = arctangent_of_quotient(direction.x, direction.z);
    float from_top = arctangent_of_quotient(length(direction.xz), direction.y);
    return vec2(0.5 - 0.5 * INVERSE_PI * longitude, INVERSE_PI * from_top);
}

#endif
