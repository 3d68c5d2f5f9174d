#version 460
#extension GL_GOOGLE_include_directive : require

// As shadow_map.frag, and lets light through the holes of a masked surface.

#include "shading/shadows/shadow_slope.glsl"
#include "shading/unfiltered_texel.glsl"

layout(location = 0) in vec4 interpolated_coordinates;
layout(location = 1) in vec4 interpolated_colour;

layout(location = 0) out vec2 slope;

void main() {
    slope = shadow_slope();
    surface_point surface;
    surface.coordinates = interpolated_coordinates;
    surface.colour = interpolated_colour;
    if (!is_kept(unfiltered_base_colour(surface).a, surface))
        discard;
}
