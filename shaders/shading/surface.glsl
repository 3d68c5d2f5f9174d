#ifndef SURFACE_GLSL
#define SURFACE_GLSL

// A point of a surface with its footprint, and the blocks and maps that all filters read. Where the
// point comes from is not known here: shading/pixel.glsl makes those of lobe's own pictures, a host
// makes its own (lobe/surface.glsl).

#include "interface/knobs.h"
#include "interface/material.h"
#include "interface/specialisation.h"

// Where resources are bound. Hosts that include these files may choose another descriptor set, and
// a number to add to those of the bindings.
#ifndef LOBE_SET
#define LOBE_SET 0
#endif
#ifndef LOBE_BINDING_BASE
#define LOBE_BINDING_BASE 0
#endif
#define LOBE_DESCRIPTOR(number) set = LOBE_SET, binding = LOBE_BINDING_BASE + number

layout(constant_id = SPECIALISE_MODEL) const uint MODEL = MODEL_MICROFACET;
layout(constant_id = SPECIALISE_DISTRIBUTION) const uint DISTRIBUTION = DISTRIBUTION_GGX;
layout(constant_id = SPECIALISE_LOBE_COUNT) const uint LOBE_COUNT = 1;
layout(constant_id = SPECIALISE_MAPS) const uint MAPS = 0;
layout(constant_id = SPECIALISE_SECOND_COORDINATES) const uint SECOND_COORDINATES = 0;
layout(constant_id = SPECIALISE_NORMALS) const uint NORMALS = NORMALS_UNSIGNED;
layout(constant_id = SPECIALISE_DIFFUSE) const bool DIFFUSE = true;
layout(constant_id = SPECIALISE_NORMAL_CONCENTRATION) const bool NORMAL_CONCENTRATION = false;
layout(constant_id = SPECIALISE_ALPHA_MASK) const bool ALPHA_MASK = false;
layout(constant_id = SPECIALISE_EMISSION) const bool EMISSION = false;
layout(constant_id = SPECIALISE_VERTEX_COLOUR) const bool VERTEX_COLOUR = false;
layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = true;
layout(constant_id = SPECIALISE_LIGHTS_AT_ONCE) const uint LIGHTS_AT_ONCE = 4;
layout(constant_id = SPECIALISE_BASE_AS_LOBE) const bool BASE_AS_LOBE = false;
layout(constant_id = SPECIALISE_CURVATURE) const bool CURVATURE = false;
layout(constant_id = SPECIALISE_DISPLACED) const bool DISPLACED = false;
layout(constant_id = SPECIALISE_STRETCHED) const bool STRETCHED = false;
layout(constant_id = SPECIALISE_HEIGHTS_TURNED) const bool HEIGHTS_TURNED = false;

layout(LOBE_DESCRIPTOR(10), std140) uniform knob_block { shared_knobs knobs; };

#include "shading/curvature.glsl"

layout(LOBE_DESCRIPTOR(3), std140) uniform material_block { material_constants material; };

layout(LOBE_DESCRIPTOR(4)) uniform sampler2D base_colour_map;
layout(LOBE_DESCRIPTOR(5)) uniform sampler2D normal_map;
layout(LOBE_DESCRIPTOR(6)) uniform sampler2D width_map;
layout(LOBE_DESCRIPTOR(7)) uniform sampler2D specular_map;
layout(LOBE_DESCRIPTOR(8)) uniform sampler2D emissive_map;
layout(LOBE_DESCRIPTOR(9)) uniform sampler2D occlusion_map;

// A point of the macro-surface. Directions whose name does not mention a space are in its tangent
// frame: x along the tangent, z along the interpolated normal.
struct surface_point {
    mat3 world_from_tangent; // orthonormal; mirrored where the texture coordinates are
    vec3 outgoing;           // unit, towards the viewer
    vec4 coordinates;        // two sets of texture coordinates
    vec4 coordinates_dx;     // their change over the sample's footprint, along x
    vec4 coordinates_dy;
    vec4 colour;
    vec3 curvature; // covariance (xx, yy, xy) of the interpolated normals under the pixel, in the
                    // plane of the tangent frame; 0 if the knob curvature is 0
    uvec2 pixel; // of the picture: seed of what differs from pixel to pixel
    // Of masked materials, which keep a share of the pixels that see them:
    float depth;  // along the view, metres
    float dither; // [0, 1): another one for each sample of the pixel
    // Of displaced geometry (DISPLACED):
    vec2 drawn_slope;     // of the triangle that is seen, over the plane of the frame
    float vertex_spacing; // how far vertices are apart, in widths of the sample
    // Of maps made from heights (STRETCHED): slopes in the frame from those of the map.
    mat2 stretch;
    // Of heights whose set of coordinates is not the one that tangents follow (HEIGHTS_TURNED):
    // from the tangent frame to that set's, whose x runs along u, and y against v.
    mat2 heights_frame;
};

bool has_map(int map) {
    return (MAPS & (1u << map)) != 0u;
}

// Texture coordinates at which a map is read (`one`: 1), or a difference of them (`one`: 0).
vec2 map_coordinates(int map, vec4 both_sets, float one) {
    vec2 set = (SECOND_COORDINATES & (1u << map)) != 0u ? both_sets.zw : both_sets.xy;
    vec3 row = vec3(set, one);
    return vec2(dot(material.transforms[2 * map].xyz, row),
                dot(material.transforms[2 * map + 1].xyz, row));
}

#endif
