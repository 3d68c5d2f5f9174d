#ifndef FRAGMENT_GLSL
#define FRAGMENT_GLSL

// What a mesh gives each of its pixels, interpolated over the triangle that is drawn. What includes
// this file has the blocks `frame`, `draw` and `knobs`, and the constants.

#include "shading/curvature.glsl"
#include "shading/tangent_frame.glsl"

layout(location = 0) in vec3 position_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 tangent_in;
layout(location = 3) in vec4 coordinates_in;
layout(location = 4) in vec4 colour_in;
layout(location = 5) in float map_width_in;
layout(location = 6) flat in float vertex_spacing_in;

struct mesh_point {
    vec3 position; // in the world, metres; its change to the right and down by a pixel
    vec3 position_dx;
    vec3 position_dy;
    vec3 normal;
    vec4 tangent;
    vec4 coordinates; // two sets; their change by a pixel
    vec4 coordinates_dx;
    vec4 coordinates_dy;
    vec4 colour;
    vec3 curvature; // see surface_point
    float map_width;
    float vertex_spacing; // pixels
    float depth;          // as drawn
    bool front;           // of the surface, not of its image where the transform mirrors
};

// The back of a surface has all axes reversed (glTF 2.0, section 3.9.6).
mat3 frame_of(mesh_point mesh) {
    mat3 from_tangent = tangent_frame(mesh.normal, mesh.tangent);
    return mesh.front ? from_tangent : -from_tangent;
}

mesh_point interpolated_point() {
    mesh_point mesh;
    mesh.position = position_in;
    mesh.position_dx = dFdx(position_in);
    mesh.position_dy = dFdy(position_in);
    mesh.normal = normal_in;
    mesh.tangent = tangent_in;
    mesh.coordinates = coordinates_in;
    mesh.coordinates_dx = dFdx(coordinates_in);
    mesh.coordinates_dy = dFdy(coordinates_in);
    mesh.colour = colour_in;
    mesh.map_width = map_width_in;
    mesh.vertex_spacing = vertex_spacing_in;
    mesh.depth = gl_FragCoord.z;
    mesh.front = gl_FrontFacing != MIRRORED;
    mesh.curvature = vec3(0.0);
    if (CURVATURE) {
        mat3 world_from_tangent = frame_of(mesh);
        vec3 normal = world_from_tangent[2];
        mesh.curvature =
            normal_covariance(frame.footprint * (dFdx(normal) * world_from_tangent).xy,
                              frame.footprint * (dFdy(normal) * world_from_tangent).xy);
    }
    return mesh;
}

#endif
