#ifndef RELIEF_FRAME_GLSL
#define RELIEF_FRAME_GLSL

// How a relief lies in the tangent frame of its carrier: a transform of the height map's texture
// coordinates may turn or mirror it, and so may these where the tangent runs along other ones.
// Texels are taken to be square in the world.

#include "shading/surface.glsl"

// The size of the height map. Each filter that draws reliefs defines it.
vec2 relief_texels();

// Of the surface that is shaded. Each filter that draws reliefs begins with it.
mat2 heights_frame = mat2(1.0);
void lay_relief_on(surface_point surface) {
    if (HEIGHTS_TURNED)
        heights_frame = surface.heights_frame;
}

// From the tangent frame to that of the map: x along its columns, y against its rows.
mat2 turn_of_map() {
    vec2 along_u = vec2(material.transforms[2 * MAP_HEIGHT].x,
                        material.transforms[2 * MAP_HEIGHT + 1].x) * relief_texels();
    vec2 along_v = vec2(material.transforms[2 * MAP_HEIGHT].y,
                        material.transforms[2 * MAP_HEIGHT + 1].y) * relief_texels();
    float size = length(along_u);
    vec2 x = size > 0.0 ? vec2(along_u.x, -along_u.y) / size : vec2(1.0, 0.0);
    bool mirrored = along_u.x * along_v.y - along_u.y * along_v.x < 0.0;
    return mat2(x, mirrored ? vec2(x.y, -x.x) : vec2(-x.y, x.x)) * heights_frame;
}

vec3 map_from_tangent(vec3 direction) {
    return vec3(turn_of_map() * direction.xy, direction.z);
}

vec3 tangent_from_map(vec3 direction) {
    return vec3(direction.xy * turn_of_map(), direction.z);
}

// The relief's y runs along the map's rows.
vec3 relief_from_tangent(vec3 direction) {
    return map_from_tangent(direction) * vec3(1.0, -1.0, 1.0);
}

vec3 tangent_from_relief(vec3 direction) {
    return tangent_from_map(direction * vec3(1.0, -1.0, 1.0));
}

#endif
