#ifndef LIB_ENVIRONMENT_MEAN_GLSL
#define LIB_ENVIRONMENT_MEAN_GLSL

#include "lib/light/cube_texel.glsl"

// Mean radiance of a cube's texel from the four texels of the level above it, weighted with their
// solid angles, so that the energy of the whole is kept. `size`: of the source's faces.
//
// The mean is taken of differences to one of the four: a constant stays exactly what it is.
vec4 environment_mean(vec4 values[4], ivec2 corner, int size) {
    vec4 weights = vec4(cube_texel_solid_angle(corner, size),
                        cube_texel_solid_angle(corner + ivec2(1, 0), size),
                        cube_texel_solid_angle(corner + ivec2(0, 1), size),
                        cube_texel_solid_angle(corner + ivec2(1, 1), size));
    weights /= (weights.x + weights.y) + (weights.z + weights.w);
    return values[0] + (weights.y * (values[1] - values[0]) + weights.z * (values[2] - values[0]) +
                        weights.w * (values[3] - values[0]));
}

#endif
