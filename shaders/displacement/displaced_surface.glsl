#ifndef DISPLACED_SURFACE_GLSL
#define DISPLACED_SURFACE_GLSL

// A displaced instance, and how the camera sees it.

#include "interface/displacement/displacement.h"

layout(set = 0, binding = 0, std140) uniform displacement_block {
    displacement_constants constants;
};

// A place in a triangle: weights of its corners, which add up to place_weight().
struct base_place {
    uint triangle;
    ivec3 weights;
};

int place_weight() {
    return (1 << PATCH_MOST) << constants.depth;
}

vec3 world_position(vec3 position) {
    precise vec3 result = vec3(dot(constants.rows[0], vec4(position, 1.0)),
                               dot(constants.rows[1], vec4(position, 1.0)),
                               dot(constants.rows[2], vec4(position, 1.0)));
    return result;
}

// Along the view, metres; not in front of the near plane. What no picture shows may throw shadows
// into it: beside and behind the camera, the distance to the eye counts.
float view_distance(vec3 world) {
    float along = dot(constants.axis.xyz, world) - constants.axis.w;
    float beside = 0.25 * constants.eye.w * length(world - constants.eye.xyz);
    return max(max(along, beside), constants.near_plane);
}

#endif
