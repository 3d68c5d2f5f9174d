#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#pragma variants MASK

// Draws what shading needs of the surfaces that are mesh. Shading reads it pixel by pixel
// (pictured_point.glsl), whatever the size of the triangles. With MASK, cuts the holes that the
// filter's own shader would.

#ifdef MASK
#include "shading/pixel.glsl"
#include "shading/mask.glsl"
#else
#include "interface/frame.h"
#include "interface/instance.h"
#include "interface/knobs.h"
#include "interface/specialisation.h"
#include "interface/picture/surfaces.h"

layout(constant_id = SPECIALISE_MIRRORED) const bool MIRRORED = false;
layout(constant_id = SPECIALISE_CURVATURE) const bool CURVATURE = false;

layout(set = 0, binding = 0, std140) uniform frame_block { frame_constants frame; };
layout(set = 0, binding = 10, std140) uniform knob_block { shared_knobs knobs; };
layout(push_constant) uniform draw_block { draw_constants draw; };

#include "shading/surfaces/fragment.glsl"

mesh_point mesh;
#endif

layout(location = SURFACES_POSITION) out vec4 position_out;
layout(location = SURFACES_NORMAL) out vec4 normal_out;
layout(location = SURFACES_TANGENT) out vec4 tangent_out;
layout(location = SURFACES_COORDINATES) out vec4 coordinates_out;
layout(location = SURFACES_GRADIENTS) out vec4 gradients_out;
// Not attached where nothing needs them.
layout(location = SURFACES_RIGHT) out vec4 right_out;
layout(location = SURFACES_DOWN) out vec4 down_out;
layout(location = SURFACES_COLOUR) out vec4 colour_out;

void main() {
#ifdef MASK
    if (!keeps_footprint(read_surface()))
        discard;
#else
    mesh = interpolated_point();
#endif
    uint whose = 4u * draw.number + (mesh.front ? SURFACES_FRONT : 0u) +
                 (mesh.tangent.w < 0.0 ? SURFACES_LEFT : 0u);
    position_out = vec4(mesh.position, float(whose));
    normal_out = vec4(mesh.normal, mesh.depth);
    tangent_out = vec4(mesh.tangent.xyz, mesh.curvature.z);
    coordinates_out = vec4(mesh.coordinates.xy, mesh.curvature.xy);
    gradients_out = vec4(mesh.coordinates_dx.xy, mesh.coordinates_dy.xy);
    right_out = vec4(mesh.position_dx, mesh.map_width);
    down_out = vec4(mesh.position_dy, mesh.vertex_spacing);
    colour_out = mesh.colour;
}
