#version 460
#extension GL_GOOGLE_include_directive : require

// Lets light through the holes of a masked surface.

#include "shading/unfiltered_texel.glsl"

layout(location = 0) in vec4 interpolated_coordinates;
layout(location = 1) in vec4 interpolated_colour;

void main() {
    surface_point surface;
    surface.coordinates = interpolated_coordinates;
    surface.colour = interpolated_colour;
    if (!is_kept(unfiltered_base_colour(surface).a, surface))
        discard;
}
