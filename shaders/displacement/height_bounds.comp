#version 460
#extension GL_GOOGLE_include_directive : require

// The least and the greatest height of squares of a height map, and how much heights change from a
// texel to the next at most: of its texels, then of four squares each.

#include "interface/displacement/displacement.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D height_map;
layout(set = 0, binding = 1, std430) buffer bounds_block { vec4 bounds[]; };

layout(push_constant) uniform constants_block { height_bounds_constants constants; };

// As shaders/displacement/height_map.glsl reads them. The map repeats: where it does not, changes
// at its end are overestimated.
float height_at(ivec2 texel) {
    ivec2 size = ivec2(constants.width, constants.height);
    float height = texelFetch(height_map, texel % size, 0).r;
    return height > 0.0 ? min(height, 1.0) : 0.0;
}

vec4 bounds_of_texels(ivec2 square) {
    ivec2 first = square * HEIGHT_BOUNDS_TEXELS;
    ivec2 end = min(first + HEIGHT_BOUNDS_TEXELS, ivec2(constants.width, constants.height));
    vec4 result = vec4(1.0, 0.0, 0.0, 0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            float height = height_at(ivec2(x, y));
            result.x = min(result.x, height);
            result.y = max(result.y, height);
            result.z = max(result.z, abs(height_at(ivec2(x + 1, y)) - height));
            result.w = max(result.w, abs(height_at(ivec2(x, y + 1)) - height));
        }
    }
    return result;
}

vec4 bounds_of_squares(ivec2 square) {
    vec4 result = vec4(1.0, 0.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 part = 2 * square + ivec2(i & 1, i >> 1);
        if (part.x >= int(constants.source_columns) || part.y >= int(constants.source_rows))
            continue;
        vec4 own = bounds[constants.source + uint(part.y) * constants.source_columns +
                          uint(part.x)];
        result = vec4(min(result.x, own.x), max(result.yzw, own.yzw));
    }
    return result;
}

void main() {
    ivec2 square = ivec2(gl_GlobalInvocationID.xy);
    if (square.x >= int(constants.columns) || square.y >= int(constants.rows))
        return;
    bounds[constants.target + uint(square.y) * constants.columns + uint(square.x)] =
        constants.source_columns == 0u ? bounds_of_texels(square) : bounds_of_squares(square);
}
