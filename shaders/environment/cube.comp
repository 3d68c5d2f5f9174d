#version 460
#extension GL_GOOGLE_include_directive : require

// Builds the six faces of an environment from its image. Each texel is the mean radiance over its
// solid angle, from subsamples at most a quarter of an image texel apart. A sun of two texels keeps
// its energy to 1 %, and to 0.15 % on average.

#include "environment/cube.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Those that poles.comp makes.
bool is_polar(ivec3 texel) {
    ivec2 from_middle = abs(2 * texel.xy + 1 - int(constants.size));
    return (texel.z == 2 || texel.z == 3) &&
           all(lessThan(from_middle, ivec2(int(constants.polar_width))));
}

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel.xy, ivec2(int(constants.size)))) || is_polar(texel))
        return;
    vec3 base;
    vec4 sum = sum_of_points(texel, 0, 1, base);
    store_mean(texel, base, sum);
}
