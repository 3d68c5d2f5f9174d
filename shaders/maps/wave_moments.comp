#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a filtered map of waves, half as large as the maps of the waves: the moments
// of slopes of each layer, weighted with the area that choppiness leaves to a point, so that they
// are means over the surface as it is seen. Divided by the mean area after filtering. The surface
// is interpolated between texels, as in shading: see lib/map/texel_point.glsl.

#include "lib/map/displaced_slope.glsl"
#include "lib/map/texel_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray wave_fields;
layout(set = 0, binding = 1) uniform writeonly image2DArray wave_moments;

layout(push_constant) uniform constants_block { wave_moments_constants constants; };

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(position.xy, imageSize(wave_moments).xy)))
        return;
    vec4 first = vec4(0.0), second = vec4(0.0), place = vec4(0.0);
    const float weight = 1.0 / float(4 * TEXEL_POINTS);
    for (int i = 0; i < 4 * TEXEL_POINTS; ++i) {
        ivec2 texel = 2 * position.xy + ivec2(i & 1, (i >> 1) & 1);
        vec2 point = (vec2(texel) + 0.5 + texel_point(i >> 2)) / float(constants.size);
        float layer = float(OCEAN_FIELDS * position.z);
        vec4 moved = textureLod(wave_fields, vec3(point, layer + OCEAN_FIELD_PLACE), 0.0);
        vec4 gradients = textureLod(wave_fields, vec3(point, layer + OCEAN_FIELD_GRADIENTS), 0.0);
        displaced_slope waves = displaced_slope_of(gradients, moved.w);
        first += weight * first_wave_moments(waves);
        second += weight * second_wave_moments(waves);
        place.xy += weight * moved.yz;
    }
    int layer = WAVE_MAP_LAYERS * position.z;
    imageStore(wave_moments, ivec3(position.xy, layer + WAVE_LAYER_FIRST), first);
    imageStore(wave_moments, ivec3(position.xy, layer + WAVE_LAYER_SECOND), second);
    imageStore(wave_moments, ivec3(position.xy, layer + WAVE_LAYER_PLACE), place);
}
