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

// What is within a cell comes into sight before, and after, its facets as a whole do.
const float LEAST_HALF_WIDTH = 0.2;

// Barycentric coordinates of three points of a facet, whose mean is exact for polynomials of
// degree 2.
const vec3 POINTS[3] = vec3[3](vec3(4.0, 1.0, 1.0) / 6.0, vec3(1.0, 4.0, 1.0) / 6.0,
                               vec3(1.0, 1.0, 4.0) / 6.0);

// Sines of the elevations between which a facet comes into sight, as if its horizons were spread
// evenly: with their mean and deviation.
vec2 horizons_of_facet(vec2 quad, vec2 third, float corner, vec2 slope, vec2 along,
                       wu_level level) {
    vec2 spacing = vec2(level.spacing_x, level.spacing_y);
    float own = max(dot(slope * level.unit / spacing, along), 0.0);
    float period = float(max(wu.width, wu.height)), mean = 0.0, square = 0.0;
    for (uint i = 0u; i < 3u; ++i) {
        // Corners are (0, 0), `third` and (1, 1).
        vec2 place = POINTS[i].y * third + POINTS[i].z;
        float tangent = horizon(vec3(quad + place, corner + dot(slope, place)), along / spacing,
                                level.unit, LEAST_RISE, period, own);
        float sine = tangent * inversesqrt(1.0 + tangent * tangent);
        mean += sine / 3.0;
        square += sine * sine / 3.0;
    }
    float half_width =
        max(sqrt(3.0 * max(square - mean * mean, 0.0)), min(LEAST_HALF_WIDTH, mean));
    return vec2(mean - half_width, mean + half_width);
}

void main() {
    wu_level level = wu.levels[stage.level];
    uint index = gl_GlobalInvocationID.x;
    if (index >= level.width * level.height)
        return;
    ivec2 quad = ivec2(index % level.width, index / level.width);
    vec4 corners = quad_heights(quad);
    vec2 lower = facet_slope(corners, false), upper = facet_slope(corners, true);
    vec2 spacing = vec2(level.spacing_x, level.spacing_y);
    uint cell = level.first_cell + index;
    cells[cell].slopes = vec4(lower * level.unit / spacing, upper * level.unit / spacing);
    for (uint i = 0u; i < WU_AZIMUTHS; ++i) {
        float azimuth = 2.0 * PI * float(i) / float(WU_AZIMUTHS);
        vec2 along = vec2(cos(azimuth), sin(azimuth));
        cells[cell].horizons[i] = packUnorm4x8(
            vec4(horizons_of_facet(vec2(quad), vec2(1.0, 0.0), corners.x, lower, along, level),
                 horizons_of_facet(vec2(quad), vec2(0.0, 1.0), corners.x, upper, along, level)));
    }
}
