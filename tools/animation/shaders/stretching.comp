#version 460
#extension GL_GOOGLE_include_directive : require

// A weave that slides over its surface and stretches, wave by wave: each point shows the point of
// the base map that has come there, with the slopes that stretching leaves. A function of time
// alone. (Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", section 5.2, animates its cloth's
// normal map.)

#include "lib/number/constants.glsl"
#include "slope_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Of the waves, in tiles of the map: how far points move, and how many waves lie side by side.
const float reach = 0.045;
const vec2 waves = vec2(2.0, 1.0);

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(texels);
    if (any(greaterThanEqual(texel, size)))
        return;
    vec2 place = (vec2(texel) + 0.5) / vec2(size);
    vec2 phase = 2.0 * PI * (waves * place.yx + vec2(0.35, -0.2) * time);
    vec2 along = 2.0 * PI * (waves.yx * place + vec2(0.15, 0.25) * time);
    vec2 source = place + vec2(0.03, 0.01) * time + reach * (sin(phase) + 0.7 * sin(along));
    // The height at `place` is the base's at `source`: its slopes follow by the chain rule.
    vec2 shear = 2.0 * PI * reach * waves * cos(phase);
    vec2 stretch = 1.0 + 0.7 * 2.0 * PI * reach * waves.yx * cos(along);
    vec2 slope = slope_of_texel(textureLod(base, source, 0.0).rgb);
    vec2 moved = vec2(slope.x * stretch.x + slope.y * shear.y,
                      slope.x * shear.x + slope.y * stretch.y);
    imageStore(texels, texel, texel_of_slope(moved));
}
