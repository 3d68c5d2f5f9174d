#ifndef SHADOW_MAPS_GLSL
#define SHADOW_MAPS_GLSL

// How much of a light reaches a point of the triangle that is drawn, from depths that the light
// sees. The triangle's own depths follow from its plane at every texel, so that it never shadows
// itself, however low the light.

#include "interface/shadow.h"
#include "shading/lights/punctual_lights.glsl"

layout(constant_id = SPECIALISE_SHADOWS) const bool SHADOWS = false;

layout(set = 0, binding = 13) uniform texture2DArray shadow_slopes;
layout(set = 0, binding = 14) uniform texture2DArray shadow_maps;
layout(set = 0, binding = 15, std430) readonly buffer shadow_block { shadow_view shadow_views[]; };

// Which of six views looks along a direction.
uint view_along(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z)
        return direction.x > 0.0 ? 0u : 1u;
    if (size.y >= size.z)
        return direction.y > 0.0 ? 2u : 3u;
    return direction.z > 0.0 ? 4u : 5u;
}

// Directions across the triangle, in the world. Where control flow is uniform.
struct drawn_plane {
    vec3 right, down;
};

drawn_plane plane_of_triangle() {
    return drawn_plane(mesh.position_dx, mesh.position_dy);
}

// How a depth changes across clip space, on the triangle's plane.
vec2 depth_slope(shadow_view view, drawn_plane plane, vec3 place, float scale) {
    vec4 right = view.world_to_clip * vec4(plane.right, 0.0);
    vec4 down = view.world_to_clip * vec4(plane.down, 0.0);
    vec3 x = scale * (right.xyz - place * right.w), y = scale * (down.xyz - place * down.w);
    float determinant = x.x * y.y - x.y * y.x;
    float limit = view.tolerance.z + view.tolerance.w * place.z;
    if (determinant == 0.0)
        return vec2(0.0);
    vec2 slope = vec2(x.z * y.y - y.z * x.y, x.x * y.z - y.x * x.z) / determinant;
    return slope * min(1.0, limit / max(length(slope), 1e-30));
}

// The part of light `i` that reaches a point; `towards`: the direction to the light.
float light_visibility(uint i, vec3 position, vec3 towards, drawn_plane plane) {
    light source = light_at(i);
    if (source.cone.w == 0.0)
        return 1.0;
    uint layer = uint(source.cone.z) + (source.cone.w > 1.0 ? view_along(-towards) : 0u);
    shadow_view view = shadow_views[layer];
    vec4 clip = view.world_to_clip * vec4(position, 1.0);
    vec3 place = clip.xyz / clip.w;
    if (clip.w <= 0.0 || any(greaterThan(abs(place.xy), vec2(1.0))))
        return 1.0;
    vec2 slope = depth_slope(view, plane, place, 1.0 / clip.w);
    float tolerance = view.tolerance.x + view.tolerance.y * place.z;
    float size = float(textureSize(shadow_maps, 0).x);
    vec2 texel = (0.5 * place.xy + 0.5) * size - 0.5;
    ivec2 first = ivec2(floor(texel));
    vec2 share = fract(texel);
    float lit = 0.0;
    for (int tap = 0; tap < 4; ++tap) {
        ivec2 step = ivec2(tap & 1, tap >> 1);
        vec2 offset = (vec2(step) - share) * (2.0 / size);
        ivec2 read = clamp(first + step, ivec2(0), ivec2(int(size) - 1));
        float nearest = texelFetch(shadow_maps, ivec3(read, int(layer)), 0).r;
        vec2 weights = mix(1.0 - share, share, vec2(step));
        // A triangle that meets this one is before its plane or behind it, on their two sides.
        bool shadowed = nearest > place.z + dot(slope, offset) + tolerance;
        if (shadowed) {
            vec2 own = texelFetch(shadow_slopes, ivec3(read, int(layer)), 0).rg * nearest;
            shadowed = nearest - dot(own, offset) * (0.5 * size) > place.z + tolerance;
        }
        if (!shadowed)
            lit += weights.x * weights.y;
    }
    return lit;
}

#endif
