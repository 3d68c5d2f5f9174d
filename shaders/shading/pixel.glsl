#ifndef PIXEL_GLSL
#define PIXEL_GLSL

// The surface at a pixel of lobe's own pictures, interpolated over a mesh, and what else filters
// ask of a picture. Included before the filter.

#include "interface/frame.h"
#include "interface/instance.h"
#include "shading/surface.glsl"
#include "lib/map/coordinate_frame.glsl"
#include "lib/map/slope_stretch.glsl"

// The pixel's surface comes from the picture of surfaces, not from a triangle that is drawn.
layout(constant_id = SPECIALISE_DEFERRED) const bool DEFERRED = false;
layout(constant_id = SPECIALISE_MIRRORED) const bool MIRRORED = false;
layout(constant_id = SPECIALISE_VIEW) const uint VIEW = VIEW_RADIANCE;
layout(constant_id = SPECIALISE_DEPTH_AS_COVERAGE) const bool DEPTH_AS_COVERAGE = false;

layout(set = 0, binding = 0, std140) uniform frame_block { frame_constants frame; };
layout(set = 0, binding = 12, std430) readonly buffer instance_block {
    instance_constants instances[];
};
layout(push_constant) uniform draw_block { draw_constants draw; };

#include "shading/surfaces/pictured_point.glsl"

// What is drawn at the pixel; set by read_surface.
mesh_point mesh;

bool front_side() {
    return mesh.front;
}

// Distance along the view, metres.
float view_depth() {
    return dot(frame.axis.xyz, mesh.position) - frame.axis.w;
}

// The slope of the triangle, which faces the viewer, over the plane of the tangent frame. Triangles
// that stand upright or lean over are not slopes of the relief: they close gaps left by vertices
// that slide along a patch's edge. Above a slope of 7 they count as less steep, above 20 as level.
vec2 triangle_slope(surface_point surface) {
    vec3 normal = normalize(cross(mesh.position_dx, mesh.position_dy) *
                            surface.world_from_tangent);
    normal = dot(normal, surface.outgoing) < 0.0 ? -normal : normal;
    return smoothstep(0.05, 0.15, normal.z) / max(normal.z, 0.05) * -normal.xy;
}

// The back's frame is the front's reversed, and so are heights: slopes are the same over both.
mat2 stretch_at(surface_point surface) {
    vec2 size = vec2(textureSize(normal_map, 0));
    return slope_stretch(mesh.position_dx * surface.world_from_tangent,
                         mesh.position_dy * surface.world_from_tangent,
                         map_coordinates(MAP_NORMAL, mesh.coordinates_dx, 0.0),
                         map_coordinates(MAP_NORMAL, mesh.coordinates_dy, 0.0),
                         surface.outgoing,
                         front_side() ? mesh.map_width : -mesh.map_width,
                         size.y / size.x);
}

// On the back, axes and heights are reversed: the frame is the front's.
mat2 heights_frame_at(surface_point surface) {
    float side = front_side() ? 1.0 : -1.0;
    bool second = (SECOND_COORDINATES & (1u << MAP_HEIGHT)) != 0u;
    vec4 right = mesh.coordinates_dx, down = mesh.coordinates_dy;
    return coordinate_frame(
        side * (mesh.position_dx * surface.world_from_tangent).xy,
        side * (mesh.position_dy * surface.world_from_tangent).xy,
        second ? right.zw : right.xy, second ? down.zw : down.xy);
}

surface_point read_surface() {
    surface_point surface;
    if (DEFERRED)
        mesh = pictured_point();
    else
        mesh = interpolated_point();
    surface.world_from_tangent = frame_of(mesh);
    vec3 world_outgoing = normalize(frame.eye.xyz - mesh.position * frame.eye.w);
    surface.outgoing = world_outgoing * surface.world_from_tangent;
    surface.coordinates = mesh.coordinates;
    surface.coordinates_dx = frame.footprint * mesh.coordinates_dx;
    surface.coordinates_dy = frame.footprint * mesh.coordinates_dy;
    surface.colour = mesh.colour;
    surface.curvature = mesh.curvature;
    surface.pixel = uvec2(gl_FragCoord.xy);
    surface.depth = view_depth();
    surface.dither = frame.dither;
    surface.drawn_slope = vec2(0.0);
    surface.vertex_spacing = 0.0;
    if (DISPLACED) {
        surface.drawn_slope = triangle_slope(surface);
        surface.vertex_spacing = mesh.vertex_spacing / frame.footprint;
    }
    surface.stretch = mat2(1.0);
    if (STRETCHED)
        surface.stretch = stretch_at(surface);
    surface.heights_frame = mat2(1.0);
    if (HEIGHTS_TURNED)
        surface.heights_frame = heights_frame_at(surface);
    return surface;
}

// Mixtures of lobes are built for a mesh's front; on the back, both they and the frame are
// reversed.
mat3 world_from_front(surface_point surface) {
    return front_side() ? surface.world_from_tangent : -surface.world_from_tangent;
}

// To the space of the draw's only instance. For a rotation with a uniform scale, the transpose is
// the inverse up to a factor.
mat3 object_from_tangent(surface_point surface) {
    instance_constants instance = instances[draw.first_instance];
    mat3 world_from_object =
        transpose(mat3(instance.rows[0].xyz, instance.rows[1].xyz, instance.rows[2].xyz));
    mat3 frame = transpose(world_from_object) * world_from_front(surface);
    return frame * inversesqrt(dot(frame[0], frame[0]));
}

mat3 camera_from_tangent(surface_point surface) {
    return mat3(frame.world_to_camera) * world_from_front(surface);
}

#endif
