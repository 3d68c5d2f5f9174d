#ifndef SURFACE_GLSL
#define SURFACE_GLSL

// The interpolated surface at a pixel, and the blocks that all filters read.

#include "interface/frame.h"
#include "interface/instance.h"
#include "interface/knobs.h"
#include "interface/material.h"
#include "interface/specialisation.h"
#include "shading/tangent_frame.glsl"

layout(constant_id = SPECIALISE_MODEL) const uint MODEL = MODEL_MICROFACET;
layout(constant_id = SPECIALISE_DISTRIBUTION) const uint DISTRIBUTION = DISTRIBUTION_GGX;
layout(constant_id = SPECIALISE_LOBE_COUNT) const uint LOBE_COUNT = 1;
layout(constant_id = SPECIALISE_MAPS) const uint MAPS = 0;
layout(constant_id = SPECIALISE_SECOND_COORDINATES) const uint SECOND_COORDINATES = 0;
layout(constant_id = SPECIALISE_DIFFUSE) const bool DIFFUSE = true;
layout(constant_id = SPECIALISE_NORMAL_CONCENTRATION) const bool NORMAL_CONCENTRATION = false;
layout(constant_id = SPECIALISE_ALPHA_MASK) const bool ALPHA_MASK = false;
layout(constant_id = SPECIALISE_EMISSION) const bool EMISSION = false;
layout(constant_id = SPECIALISE_VERTEX_COLOUR) const bool VERTEX_COLOUR = false;
layout(constant_id = SPECIALISE_METALLIC_MAP) const bool METALLIC_MAP = true;
layout(constant_id = SPECIALISE_MIRRORED) const bool MIRRORED = false;
layout(constant_id = SPECIALISE_DIRECTIONAL_LIGHTS) const bool DIRECTIONAL_LIGHTS = false;
layout(constant_id = SPECIALISE_POINT_LIGHTS) const bool POINT_LIGHTS = false;
layout(constant_id = SPECIALISE_SPOT_LIGHTS) const bool SPOT_LIGHTS = false;
layout(constant_id = SPECIALISE_LIGHTS_AT_ONCE) const uint LIGHTS_AT_ONCE = 4;
layout(constant_id = SPECIALISE_VIEW) const uint VIEW = VIEW_RADIANCE;
layout(constant_id = SPECIALISE_BASE_AS_LOBE) const bool BASE_AS_LOBE = false;
layout(constant_id = SPECIALISE_CURVATURE) const bool CURVATURE = false;
layout(constant_id = SPECIALISE_DEPTH_AS_COVERAGE) const bool DEPTH_AS_COVERAGE = false;

layout(set = 0, binding = 0, std140) uniform frame_block { frame_constants frame; };
layout(set = 0, binding = 10, std140) uniform knob_block { shared_knobs knobs; };
layout(set = 0, binding = 3, std140) uniform material_block { material_constants material; };
layout(set = 0, binding = 12, std430) readonly buffer instance_block {
    instance_constants instances[];
};
layout(push_constant) uniform draw_block { draw_constants draw; };

layout(set = 0, binding = 4) uniform sampler2D base_colour_map;
layout(set = 0, binding = 5) uniform sampler2D normal_map;
layout(set = 0, binding = 6) uniform sampler2D width_map;
layout(set = 0, binding = 7) uniform sampler2D specular_map;
layout(set = 0, binding = 8) uniform sampler2D emissive_map;
layout(set = 0, binding = 9) uniform sampler2D occlusion_map;

layout(location = 0) in vec3 interpolated_position;
layout(location = 1) in vec3 interpolated_normal;
layout(location = 2) in vec4 interpolated_tangent;
layout(location = 3) in vec4 interpolated_coordinates;
layout(location = 4) in vec4 interpolated_colour;

// A point of the macro-surface. Directions whose name does not mention a space are in its tangent
// frame: x along the tangent, z along the interpolated normal.
struct surface_point {
    vec3 world_position;
    mat3 world_from_tangent; // orthonormal; mirrored where the texture coordinates are
    vec3 outgoing;           // unit, towards the viewer
    vec4 coordinates;        // two sets of texture coordinates
    vec4 coordinates_dx;     // their change over the sample's footprint, along x
    vec4 coordinates_dy;
    vec4 colour;
    vec3 curvature; // covariance (xx, yy, xy) of the interpolated normals under the pixel, in the
                    // plane of the tangent frame; 0 if the knob curvature is 0
};

bool has_map(int map) {
    return (MAPS & (1u << map)) != 0u;
}

bool front_side() {
    return gl_FrontFacing != MIRRORED;
}

// A larger variance means that the pixel is at a silhouette, where derivatives are meaningless.
const float CURVATURE_MAXIMUM = 0.1;

// Covariance of the macro-surface's normal over the sample's box, assuming that it changes linearly
// from pixel to pixel: a box of width one has the variance 1/12.
vec3 normal_covariance(vec3 normal, mat3 world_from_tangent) {
    vec2 dx = frame.footprint * (dFdx(normal) * world_from_tangent).xy;
    vec2 dy = frame.footprint * (dFdy(normal) * world_from_tangent).xy;
    vec3 covariance = (knobs.curvature / 12.0) * vec3(dx * dx + dy * dy, dx.x * dx.y + dy.x * dy.y);
    float variance = max(covariance.x, covariance.y);
    return covariance * min(1.0, CURVATURE_MAXIMUM / max(variance, 1e-30));
}

surface_point read_surface() {
    surface_point surface;
    surface.world_position = interpolated_position;
    mat3 from_tangent = tangent_frame(interpolated_normal, interpolated_tangent);
    // The back of a surface has all axes reversed (glTF 2.0, section 3.9.6).
    surface.world_from_tangent = front_side() ? from_tangent : -from_tangent;
    vec3 world_outgoing = normalize(frame.eye.xyz - interpolated_position * frame.eye.w);
    surface.outgoing = world_outgoing * surface.world_from_tangent;
    surface.coordinates = interpolated_coordinates;
    surface.coordinates_dx = frame.footprint * dFdx(interpolated_coordinates);
    surface.coordinates_dy = frame.footprint * dFdy(interpolated_coordinates);
    surface.colour = interpolated_colour;
    surface.curvature = vec3(0.0);
    if (CURVATURE)
        surface.curvature =
            normal_covariance(surface.world_from_tangent[2], surface.world_from_tangent);
    return surface;
}

// Texture coordinates at which a map is read (`one`: 1), or a difference of them (`one`: 0).
vec2 map_coordinates(int map, vec4 both_sets, float one) {
    vec2 set = (SECOND_COORDINATES & (1u << map)) != 0u ? both_sets.zw : both_sets.xy;
    vec3 row = vec3(set, one);
    return vec2(dot(material.transforms[2 * map].xyz, row),
                dot(material.transforms[2 * map + 1].xyz, row));
}

#endif
