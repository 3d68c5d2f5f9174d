#ifndef HEIGHT_BOUNDS_GLSL
#define HEIGHT_BOUNDS_GLSL

// Bounds of the heights over a part of the base mesh, from what height_bounds.comp wrote.

#include "displacement/height_map.glsl"

layout(set = 0, binding = 14, std430) readonly buffer bounds_block { vec4 bounds[]; };

struct height_bounds {
    float least, greatest;
    vec2 change; // from a texel to the next along u and v, at most
};

uvec2 squares_of(uint level) {
    uvec2 squares = (uvec2(constants.width, constants.height) + uint(HEIGHT_BOUNDS_TEXELS) - 1u) /
                    uint(HEIGHT_BOUNDS_TEXELS);
    return (squares + (1u << level) - 1u) >> level;
}

vec4 square_at(uint level, uvec2 square) {
    uint first = 0u;
    for (uint i = 0u; i < level; ++i)
        first += squares_of(i).x * squares_of(i).y;
    return bounds[first + square.y * squares_of(level).x + square.x];
}

// Texels within [0, count) of the places where a range begins and ends and of the map's end, if
// that is between.
uvec3 texels_of_range(float low, float high, uint count, uint wrap) {
    float size = float(count);
    float first = wrapped(low, wrap) * size, last = wrapped(high, wrap) * size;
    float between = first;
    if (wrap != WRAP_CLAMP && floor(high) > floor(low))
        between = wrap == WRAP_MIRROR && mod(floor(high), 2.0) == 0.0 ? 0.0 : size;
    return uvec3(min(vec3(first, between, last), vec3(size - 1.0)));
}

// Over a rectangle of the map. The level of whose squares no more than two lie side by side in it.
height_bounds bounds_over(vec2 low, vec2 high) {
    vec2 texels = (high - low) * vec2(constants.width, constants.height);
    float extent = max(texels.x, texels.y) / float(HEIGHT_BOUNDS_TEXELS);
    uint top = constants.bounds_levels - 1u;
    uint level = extent < 1e6 ? min(uint(max(ceil(log2(max(extent, 1.0))), 0.0)), top) : top;
    uint texel_shift = level + uint(findMSB(HEIGHT_BOUNDS_TEXELS));
    vec4 result = vec4(1.0, 0.0, 0.0, 0.0);
    if (level == top) {
        result = square_at(top, uvec2(0u));
    } else {
        uvec3 x = texels_of_range(low.x, high.x, constants.width, constants.wrap_u) >> texel_shift;
        uvec3 y = texels_of_range(low.y, high.y, constants.height, constants.wrap_v) >> texel_shift;
        [[dont_unroll]]
        for (int i = 0; i < 9; ++i) {
            vec4 own = square_at(level, uvec2(x[i % 3], y[i / 3]));
            result = vec4(min(result.x, own.x), max(result.yzw, own.yzw));
        }
    }
    return height_bounds(result.x, result.y, result.zw);
}

height_bounds bounds_of_map() {
    vec4 all = square_at(constants.bounds_levels - 1u, uvec2(0u));
    return height_bounds(all.x, all.y, all.zw);
}

#endif
