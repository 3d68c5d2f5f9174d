#version 460
#extension GL_GOOGLE_include_directive : require

// Third step: what nine harmonics miss of the irradiance, for each normal of a map. Of lamps that
// stand at a surface's horizon they miss up to a tenth of the lamps' peak, and a floor among such
// lamps was a fifth too bright. And how the light near each normal's horizon is shared between
// above and below. Sums over the texels of a cube, each a light in the direction of its centre.

#include "interface/environment/irradiance_harmonics.h"
#include "lib/light/cube_texel.glsl"
#include "lib/light/luminance.glsl"
#include "lib/light/octahedron.glsl"
#include "lib/light/spherical_harmonics.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler2DArray environment;
layout(set = 0, binding = 1, std140) uniform harmonics_block { irradiance_harmonics harmonics; };
layout(set = 0, binding = 2) uniform writeonly image2D remainder_map;

layout(push_constant) uniform constants_block { irradiance_remainder_constants constants; };

void main() {
    const int width = HARMONICS_REMAINDER_WIDTH;
    int index = int(gl_GlobalInvocationID.x), size = int(constants.size);
    ivec2 place = ivec2(index % width, index / width);
    vec3 normal = octahedron_texel_direction(place, HARMONICS_REMAINDER_SIZE);
    vec4 sum = vec4(0.0);     // w: of uniform light, whose sum is pi but for the cube's texels
    vec2 horizon = vec2(0.0); // luminance below, and in all
    for (ivec3 texel = ivec3(0); texel.z < 6; texel = next_cube_texel(texel, size)) {
        vec4 power = cube_texel_solid_angle(texel.xy, size) *
                     vec4(texelFetch(environment, texel, 0).rgb, 1.0);
        float cosine = dot(normal, cube_texel_direction(texel.z, texel.xy, size));
        sum += max(cosine, 0.0) * power;
        float near =
            max(1.0 - abs(cosine) / HARMONICS_HORIZON_SINE, 0.0) * lobe_luminance(power.rgb);
        // Texels at the horizon, 0.05 wide, are on both sides.
        horizon += near * vec2(clamp(0.5 - 20.0 * cosine, 0.0, 1.0), 1.0);
    }
    if (place.y >= width)
        return;
    vec3 known = harmonic_irradiance_by_degree(harmonics.coefficients, normal, 1.0, 1.0);
    vec3 irradiance = PI / sum.w * sum.rgb;
    vec3 remainder = constants.is_zero != 0u ? vec3(0.0) : irradiance - known;
    imageStore(remainder_map, place,
               vec4(remainder, horizon.y > 0.0 ? horizon.x / horizon.y : 0.5));
}
