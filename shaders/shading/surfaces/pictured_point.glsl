#ifndef PICTURED_POINT_GLSL
#define PICTURED_POINT_GLSL

// What of a mesh is seen at a pixel, read from the picture of surfaces.

#include "interface/picture/surfaces.h"
#include "shading/surfaces/fragment.glsl"

// Without a sampler: some shaders have as many as lavapipe allows, 32.
layout(set = 0, binding = 55) uniform texture2DArray surfaces;

vec4 layer_of_surfaces(int layer) {
    return texelFetch(surfaces, ivec3(gl_FragCoord.xy, layer), 0);
}

mesh_point pictured_point() {
    vec4 position = layer_of_surfaces(SURFACES_POSITION);
    vec4 normal = layer_of_surfaces(SURFACES_NORMAL);
    vec4 tangent = layer_of_surfaces(SURFACES_TANGENT);
    vec4 coordinates = layer_of_surfaces(SURFACES_COORDINATES);
    vec4 gradients = layer_of_surfaces(SURFACES_GRADIENTS);
    vec4 right = layer_of_surfaces(SURFACES_RIGHT), down = layer_of_surfaces(SURFACES_DOWN);
    uint whose = uint(position.w);
    mesh_point mesh;
    mesh.position = position.xyz;
    mesh.position_dx = right.xyz;
    mesh.position_dy = down.xyz;
    mesh.normal = normal.xyz;
    mesh.tangent = vec4(tangent.xyz, (whose & SURFACES_LEFT) != 0u ? -1.0 : 1.0);
    mesh.coordinates = vec4(coordinates.xy, 0.0, 0.0);
    mesh.coordinates_dx = vec4(gradients.xy, 0.0, 0.0);
    mesh.coordinates_dy = vec4(gradients.zw, 0.0, 0.0);
    mesh.colour = VERTEX_COLOUR ? layer_of_surfaces(SURFACES_COLOUR) : vec4(1.0);
    mesh.curvature = vec3(coordinates.zw, tangent.w);
    mesh.map_width = right.w;
    mesh.vertex_spacing = down.w;
    mesh.depth = normal.w;
    mesh.front = (whose & SURFACES_FRONT) != 0u;
    return mesh;
}

#endif
