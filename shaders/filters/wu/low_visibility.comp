#version 460
#extension GL_GOOGLE_include_directive : require

// Which facets of the coarse relief's cell under each path's start see each direction of the table:
// bits, lower and upper. A thread for each path and direction.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 5, std430) writeonly buffer sight_block { uint sights[]; };

void main() {
    uint directions = filled_direction_count();
    uint index = gl_GlobalInvocationID.x / directions, which = gl_GlobalInvocationID.x % directions;
    if (index >= path_count())
        return;
    uint cell = cell_at(wu.levels[stage.level], path_start(index));
    vec2 areas = seen_areas(cell, direction_of_index(min(which, direction_count() - 1u),
                                                     wu.angular));
    sights[gl_GlobalInvocationID.x] = (areas.x > 0.0 ? 1u : 0u) + (areas.y > 0.0 ? 2u : 0u);
}
