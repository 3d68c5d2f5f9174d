#ifndef HEIGHT_MAP_GLSL
#define HEIGHT_MAP_GLSL

// Heights over the base mesh. Maps are read texel by texel and interpolated here, as samplers have
// no more than 8 bits between texels: too few for a surface seen from near.

#include "displacement/coordinates.glsl"

// Length over which the map's u and v grow by 1 at each chart, the object's.
layout(set = 0, binding = 6, std430) readonly buffer length_block { vec2 lengths[]; };
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

// Of the squares that are as wide as vertices are apart, `spacing` metres.
float spacing_level(vec2 chart_lengths, float spacing) {
    vec2 texels = (spacing / constants.scale) * vec2(constants.width, constants.height) /
                  max(chart_lengths, vec2(1e-30));
    float most = max(texels.x, texels.y), top = float(constants.levels - 1u);
    return most < 1e30 ? clamp(log2(max(most, 1e-30)), min(constants.least_level, top), top) : top;
}

// A place in one of the charts that have it.
struct chart_place {
    vec2 coordinates, lengths;
};

chart_place place_of_pair(uint pair, float part) {
    uint first = pairs[2u * pair], second = pairs[2u * pair + 1u];
    vec2 start = chart_coordinates(first);
    precise vec2 coordinates = start + part * (chart_coordinates(second) - start);
    precise vec2 mean = lengths[first] + part * (lengths[second] - lengths[first]);
    return chart_place(coordinates, mean);
}

chart_place place_in_triangle(uint triangle, vec3 weights) {
    chart_place result = chart_place(vec2(0.0), vec2(0.0));
    for (int i = 0; i < 3; ++i) {
        uint chart = triangles[triangle].charts[i];
        result.coordinates += weights[i] * chart_coordinates(chart);
        result.lengths += weights[i] * lengths[chart];
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
        result = chart_place(chart_coordinates(chart), lengths[chart]);
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
        sum += height_at(place.coordinates, spacing_level(place.lengths, spacing));
    }
    return sum / float(count);
}

#endif
