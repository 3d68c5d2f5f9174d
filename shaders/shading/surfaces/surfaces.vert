#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

// One triangle over all pixels in which a batch is seen, at the depth of its number. Shading reads
// the picture of surfaces, so that it needs nothing of what shading.vert gives it.

#include "interface/instance.h"
#include "interface/picture/surfaces.h"

layout(set = 0, binding = 55) uniform texture2DArray surfaces;
layout(set = 0, binding = 1, std430) readonly buffer rectangle_block {
    surface_rectangle rectangles[];
};
layout(push_constant) uniform draw_block { draw_constants draw; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec4 coordinates;
layout(location = 4) out vec4 colour;
layout(location = 5) out float map_width;
layout(location = 6) flat out float vertex_spacing;

void main() {
    position = normal = vec3(0.0);
    tangent = coordinates = colour = vec4(0.0);
    map_width = vertex_spacing = 0.0;
    surface_rectangle seen = rectangles[draw.number];
    vec2 size = vec2(textureSize(surfaces, 0).xy), end = vec2(seen.right, seen.bottom);
    vec2 start = seen.right > 0u ? size - vec2(seen.from_right, seen.from_bottom) : end;
    // Legs twice as long as the sides.
    vec2 corner = start + 2.0 * (end - start) * vec2(gl_VertexIndex == 1, gl_VertexIndex == 2);
    gl_Position = vec4(2.0 * corner / size - 1.0, float(draw.number) * SURFACES_DEPTH_OF_NUMBER,
                       1.0);
}
