#ifndef HORIZON_GLSL
#define HORIZON_GLSL

// How much of the sky a point of a relief sees.

#include "filters/displaced/height_field.glsl"

// Raises a horizon by one vertex of the line that the walk crosses.
void raise(inout float slope, relief_walk walk, vec4 corners, bool upper, float place,
           float unit) {
    vec2 inside = walk.origin.xy - vec2(walk.quad) + place * walk.direction.xy;
    float height = corners.x + dot(facet_slope(corners, upper), inside);
    if (place > 1e-4)
        slope = max(slope, unit * (height - walk.origin.z) / place);
}

void raise_by_quad(inout float slope, relief_walk walk, float unit) {
    vec4 corners = corner_heights(local_quad(walk), walk.size);
    float crossing = crossing_of_diagonal(walk);
    bool first = is_upper(walk, 0.5 * (walk.place + crossing));
    raise(slope, walk, corners, first, crossing, unit);
    raise(slope, walk, corners, is_upper(walk, 0.5 * (crossing + walk.leave)), walk.leave, unit);
}

// In periods of the map. The peak opposite of a slope may be a whole period away, and further where
// the line is oblique: with 1, valleys of slope 1 reflected 1.4 % too much.
const float REACH = 4.0;

// The tangent of the elevation above which the sky is seen in a horizontal direction, if that is
// more than `slope`. `along`: quads for each unit of length, `unit`: lengths for each of heights.
// What raises the horizon by less than `least_rise`, as a slope, is not looked for, nor what is
// further away than REACH times `period`.
float horizon(vec3 origin, vec2 along, float unit, float least_rise, float period, float slope) {
    relief_walk walk = start_walk(origin, vec3(along, 0.0), 0);
    float rise = unit * (walk.largest - origin.z);
    for (int i = 0; i < WALK_STEPS; ++i) {
        float least = (slope + least_rise) * walk.place;
        if (rise <= least || walk.place > REACH * period)
            break;
        bool goes_down = walk.level > 0 && unit * (node_maximum(walk) - origin.z) > least;
        if (goes_down)
            descend(walk);
        if (walk.level == 0)
            raise_by_quad(slope, walk, unit);
        if (!goes_down || walk.level == 0)
            advance(walk);
    }
    return slope;
}

#endif
