#ifndef SEEN_RELIEF_GLSL
#define SEEN_RELIEF_GLSL

// The point of a relief that is seen at a point of its carrier.

#include "filters/displaced/height_field.glsl"
#include "filters/displaced/relief_frame.glsl"
#include "shading/surface.glsl"

// The viewer is at least so high above the carrier, as a cosine.
const float LEAST_VIEW = 0.005;

// Change of the other set of texture coordinates with that of the height map.
vec2 change_of_other_set(surface_point surface, vec2 change, bool second) {
    mat2 first_set = mat2(surface.coordinates_dx.xy, surface.coordinates_dy.xy);
    mat2 second_set = mat2(surface.coordinates_dx.zw, surface.coordinates_dy.zw);
    mat2 own = second ? second_set : first_set, other = second ? first_set : second_set;
    return determinant(own) != 0.0 ? other * (inverse(own) * change) : vec2(0.0);
}

// The surface with the texture coordinates of a point of the relief.
surface_point surface_at(surface_point surface, vec3 position) {
    vec2 centre = map_coordinates(MAP_HEIGHT, surface.coordinates, 1.0);
    vec2 moved = (position.xy + 0.5) / vec2(relief_size()) - centre;
    moved -= floor(moved + 0.5);
    mat2 transform = transpose(mat2(material.transforms[2 * MAP_HEIGHT].xy,
                                    material.transforms[2 * MAP_HEIGHT + 1].xy));
    vec2 offset = determinant(transform) != 0.0 ? inverse(transform) * moved : vec2(0.0);
    bool second = (SECOND_COORDINATES & (1u << MAP_HEIGHT)) != 0u;
    vec2 other = SECOND_COORDINATES != 0u ? change_of_other_set(surface, offset, second) : offset;
    surface.coordinates += second ? vec4(other, offset) : vec4(offset, other);
    return surface;
}

// Where the viewer meets the relief.
relief_hit seen_point(surface_point surface) {
    vec3 outgoing = relief_from_tangent(surface.outgoing);
    outgoing.z = max(outgoing.z, LEAST_VIEW);
    vec2 place =
        fract(map_coordinates(MAP_HEIGHT, surface.coordinates, 1.0)) * vec2(relief_size()) - 0.5;
    float rise = max(largest_height() - mean_height(), 0.0) + 1e-3;
    return trace_relief(vec3(place, mean_height()) + outgoing * (rise / outgoing.z), -outgoing);
}

#endif
