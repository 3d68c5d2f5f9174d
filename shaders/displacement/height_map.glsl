#ifndef HEIGHT_MAP_GLSL
#define HEIGHT_MAP_GLSL

// Heights over the base mesh. Maps are read texel by texel and interpolated here, as samplers have
// no more than 8 bits between texels: too few for a surface seen from near.

#extension GL_EXT_control_flow_attributes : require

#include "displacement/coordinates.glsl"

layout(set = 0, binding = 6, std430) readonly buffer measure_block { chart_measure measures[]; };
layout(set = 0, binding = 8) uniform sampler2D height_map;
layout(set = 0, binding = 9) uniform sampler2D height_levels; // from level 1 on
layout(set = 0, binding = 10, std430) readonly buffer base_point_block {
    base_point base_points[];
};

// Of a coordinate on which the map repeats or ends: within [0, 1].
float wrapped(float coordinate, uint wrap) {
    if (!(abs(coordinate) < 1e7))
        return 0.0;
    if (wrap == WRAP_CLAMP)
        return clamp(coordinate, 0.0, 1.0);
    float period = wrap == WRAP_MIRROR ? 2.0 : 1.0;
    float rest = coordinate - period * floor(coordinate / period);
    return rest > 1.0 ? period - rest : rest;
}

// The texel `index` in [-1, count].
int wrapped_texel(int index, int count, uint wrap) {
    if (wrap == WRAP_REPEAT)
        return index < 0 ? index + count : index >= count ? index - count : index;
    return clamp(index, 0, count - 1);
}

// Heights are within [0, 1]; what is no number is 0.
float texel_height(ivec2 texel, int level) {
    float height = level == 0 ? texelFetch(height_map, texel, 0).r
                              : texelFetch(height_levels, texel, level - 1).r;
    return height > 0.0 ? min(height, 1.0) : 0.0;
}

float level_height(vec2 coordinates, int level) {
    ivec2 size = max(ivec2(constants.width, constants.height) >> level, ivec2(1));
    precise vec2 place = vec2(wrapped(coordinates.x, constants.wrap_u),
                              wrapped(coordinates.y, constants.wrap_v)) * vec2(size) - 0.5;
    ivec2 first = ivec2(floor(place));
    precise vec2 part = place - floor(place);
    int left = wrapped_texel(first.x, size.x, constants.wrap_u);
    int right = wrapped_texel(first.x + 1, size.x, constants.wrap_u);
    precise float result = 0.0;
    [[dont_unroll]]
    for (int row = 0; row < 2; ++row) {
        int y = wrapped_texel(first.y + row, size.y, constants.wrap_v);
        precise float height = mix(texel_height(ivec2(left, y), level),
                                   texel_height(ivec2(right, y), level), part.x);
        result += (row == 0 ? 1.0 - part.y : part.y) * height;
    }
    return result;
}

// The mean over squares as wide as 2^level texels.
float height_at(vec2 coordinates, float level) {
    int first = int(level), count = level > float(first) ? 2 : 1;
    precise float part = level - float(first);
    precise float result = 0.0;
    for (int i = 0; i < count; ++i)
        result += (i == 0 ? 1.0 - part : part) * level_height(coordinates, first + i);
    return result;
}

// A place in one of the charts that have it.
struct chart_place {
    vec2 coordinates;
    vec3 measure; // of struct chart_measure
};

vec3 measure_of(uint chart) {
    return vec3(measures[chart].lengths[0], measures[chart].lengths[1], measures[chart].edge);
}

// Of the squares that are as wide as vertices are apart, `spacing` metres, or as an edge of a patch
// lets them be where that has more texels than segments.
float spacing_level(vec3 measure, float spacing) {
    vec2 texels = (spacing / constants.scale) * vec2(constants.width, constants.height) /
                  max(measure.xy, vec2(1e-30));
    float least = measure.z / float(place_weight());
    float most = max(max(texels.x, texels.y), least), top = float(constants.levels - 1u);
    return most < 1e30 ? clamp(log2(max(most, 1e-30)), 0.0, top) : top;
}

chart_place place_of_pair(uint pair, float part) {
    uint first = pairs[2u * pair], second = pairs[2u * pair + 1u];
    vec2 start = chart_coordinates(first);
    precise vec2 coordinates = start + part * (chart_coordinates(second) - start);
    vec3 measure = measure_of(first);
    precise vec3 mean = measure + part * (measure_of(second) - measure);
    return chart_place(coordinates, mean);
}

chart_place place_in_triangle(uint triangle, vec3 weights) {
    chart_place result = chart_place(vec2(0.0), vec3(0.0));
    for (int i = 0; i < 3; ++i) {
        uint chart = triangles[triangle].charts[i];
        result.coordinates += weights[i] * chart_coordinates(chart);
        result.measure += weights[i] * measure_of(chart);
    }
    return result;
}

uint chart_count(base_site site) {
    return site.kind == SITE_POINT ? base_points[site.index].chart_count
           : site.kind == SITE_EDGE ? edges[site.index].pair_count
                                    : 1u;
}

chart_place chart_of(base_site site, uint number) {
    chart_place result;
    if (site.kind == SITE_POINT) {
        uint chart = base_points[site.index].first_chart + number;
        result = chart_place(chart_coordinates(chart), measure_of(chart));
    } else if (site.kind == SITE_EDGE) {
        result = place_of_pair(edges[site.index].first_pair + number, site.part);
    } else {
        result = place_in_triangle(site.index, site.weights);
    }
    return result;
}

// On seams, the mean over all charts, in their order.
float site_height(base_site site, float spacing) {
    uint count = chart_count(site);
    precise float sum = 0.0;
    for (uint i = 0u; i < count; ++i) {
        chart_place place = chart_of(site, i);
        sum += height_at(place.coordinates, spacing_level(place.measure, spacing));
    }
    return sum / float(count);
}

// Of a level with few texels: from where the camera is, nothing finer matters.
const uint DISTANT_LEVELS = 7u;

float distant_height(base_site site) {
    uint count = chart_count(site);
    int level = int(max(constants.levels, DISTANT_LEVELS) - DISTANT_LEVELS);
    precise float sum = 0.0;
    for (uint i = 0u; i < count; ++i)
        sum += level_height(chart_of(site, i).coordinates, level);
    return sum / float(count);
}

vec3 point_direction(uint point) {
    return vec3(points[point].direction[0], points[point].direction[1],
                points[point].direction[2]);
}

// Of displacement.
vec3 site_direction(base_site site) {
    if (site.kind == SITE_POINT)
        return point_direction(site.index);
    precise vec3 sum;
    vec3 first;
    if (site.kind == SITE_EDGE) {
        first = point_direction(edges[site.index].points[0]);
        sum = first + site.part * (point_direction(edges[site.index].points[1]) - first);
    } else {
        first = point_direction(point_of_corner(site.index, 0));
        sum = site.weights.x * first +
              site.weights.y * point_direction(point_of_corner(site.index, 1)) +
              site.weights.z * point_direction(point_of_corner(site.index, 2));
    }
    return dot(sum, sum) > 1e-8 ? normalize(sum) : first;
}

// Where the camera sees a place, roughly: in the world.
vec3 distant_position(base_site site) {
    precise vec3 result =
        site_position(site) + constants.relief * distant_height(site) * site_direction(site);
    return world_position(result);
}

float pixels_per_metre_at(base_site site) {
    return constants.perspective != 0.0
               ? constants.pixels / view_distance(distant_position(site))
               : constants.pixels;
}

#endif
