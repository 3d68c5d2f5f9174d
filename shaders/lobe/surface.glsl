#ifndef LOBE_SURFACE_GLSL
#define LOBE_SURFACE_GLSL

// The surface that a host shades, for the filters that follow (lobe/moments.glsl and so on). A host
// may define before it includes one of those:
//
//   LOBE_SET             descriptor set of all that lobe_maps_get gives; 0
//   LOBE_BINDING_BASE    added to the number of each of its bindings; 0
//   LOBE_CONSTANT_BASE   added to the identifier of each specialisation constant; 0
//   LOBE_ENVIRONMENT     the scene has an environment
//   LOBE_CLOSED_SURFACE  lobe_material_maps.closed_surface
//   LOBE_WAVES           lobe_material_maps.waves

#ifdef LOBE_ENVIRONMENT
#define ENVIRONMENT
#endif
#ifdef LOBE_CLOSED_SURFACE
#define CLOSED_SURFACE
#endif

#ifdef LOBE_WAVES
#define WAVES
#endif

#include "shading/surface.glsl"
#include "shading/tangent_frame.glsl"

#define lobe_surface surface_point

// A point of a surface. `world_from_tangent`: orthonormal columns, tangent, bitangent and normal,
// for instance of lobe_frame; all three reversed on the back. `to_viewer`: of any length, in the
// world. `uv`: texture coordinates, with their change from this pixel to the next along x and y.
// The host may then set the other set of texture coordinates, the colour, and more (see
// shading/surface.glsl).
lobe_surface lobe_surface_at(mat3 world_from_tangent, vec3 to_viewer, vec2 uv, vec2 uv_dx,
                             vec2 uv_dy) {
    lobe_surface surface;
    surface.world_from_tangent = world_from_tangent;
    surface.outgoing = normalize(to_viewer) * world_from_tangent;
    surface.coordinates = vec4(uv, uv);
    surface.coordinates_dx = vec4(uv_dx, uv_dx);
    surface.coordinates_dy = vec4(uv_dy, uv_dy);
    surface.colour = vec4(1.0);
    surface.curvature = vec3(0.0);
    surface.pixel = uvec2(0u);
    surface.depth = 1.0;
    surface.dither = 0.0;
    surface.drawn_slope = vec2(0.0);
    surface.vertex_spacing = 0.0;
    surface.stretch = mat2(1.0);
    surface.heights_frame = mat2(1.0);
    return surface;
}

// Orthonormal columns from an interpolated normal and tangent, whose w is the handedness.
mat3 lobe_frame(vec3 normal, vec4 tangent) {
    return tangent_frame(normal, tangent);
}

// For surface.curvature: how much the surface's own normals vary under the pixel, from their change
// to the next pixel along x and y.
vec3 lobe_curvature(vec3 normal_dx, vec3 normal_dy, mat3 world_from_tangent) {
    return CURVATURE ? normal_covariance((normal_dx * world_from_tangent).xy,
                                         (normal_dy * world_from_tangent).xy)
                     : vec3(0.0);
}

// A host's maps are always in tangent space.
mat3 object_from_tangent(lobe_surface surface) {
    return mat3(1.0);
}

mat3 camera_from_tangent(lobe_surface surface) {
    return mat3(1.0);
}

#endif
