#version 460
#extension GL_GOOGLE_include_directive : require

// The slopes of the facets of a coarse relief, and their horizons in WU_AZIMUTHS directions: the
// coarse relief's own shadows. A thread a cell.

#define CELL_ACCESS
#include "filters/displaced/horizon.glsl"
#include "filters/wu/cells.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };

// What raises a horizon by less, as a slope, is not looked for.
const float LEAST_RISE = 0.005;

void main() {
    wu_level level = wu.levels[stage.level];
    uint index = gl_GlobalInvocationID.x;
    if (index >= level.width * level.height)
        return;
    ivec2 quad = ivec2(index % level.width, index / level.width);
    vec4 corners = quad_heights(quad);
    vec2 lower = facet_slope(corners, false), upper = facet_slope(corners, true);
    vec2 low_place = vec2(2.0, 1.0) / 3.0, high_place = vec2(1.0, 2.0) / 3.0;
    vec3 low_centre = vec3(vec2(quad) + low_place, corners.x + dot(lower, low_place));
    vec3 high_centre = vec3(vec2(quad) + high_place, corners.x + dot(upper, high_place));
    vec2 spacing = vec2(level.spacing_x, level.spacing_y);
    vec2 low_slope = lower * level.unit / spacing, high_slope = upper * level.unit / spacing;
    uint cell = level.first_cell + index;
    cells[cell].slopes = vec4(low_slope, high_slope);
    float period = float(max(wu.width, wu.height));
    for (uint i = 0u; i < WU_AZIMUTHS; ++i) {
        float azimuth = 2.0 * PI * float(i) / float(WU_AZIMUTHS);
        vec2 along = vec2(cos(azimuth), sin(azimuth));
        cells[cell].horizons[i] = packHalf2x16(
            vec2(horizon(low_centre, along / spacing, level.unit, LEAST_RISE, period,
                         max(dot(low_slope, along), 0.0)),
                 horizon(high_centre, along / spacing, level.unit, LEAST_RISE, period,
                         max(dot(high_slope, along), 0.0))));
    }
}
