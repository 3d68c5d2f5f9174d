#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a masked material's colours: the colour of what the mask keeps, times the
// share of the texel that it keeps. The mask is a threshold, so the mean of what it keeps is not
// what a threshold keeps of the mean.
//
// Where the map is interpolated, so is its alpha before it meets the cutoff. Between four texel
// centres it is bilinear: linear along a line, of which the part above the cutoff is exact.

#include "interface/mask.h"
#include "lib/map/box_reduction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D base_colour_map;
layout(set = 0, binding = 1) uniform writeonly image2DArray coverage_map;

layout(push_constant) uniform constants_block { mask_constants constants; };

// Lines in each quarter of a texel.
const int LINES = 4;

// Above 0 or equal: kept.
float above_cutoff(vec4 colour) {
    return colour.a * constants.alpha - constants.cutoff;
}

// The integral along a line, of length one, between two colours.
vec4 kept_of_line(vec4 from, vec4 to) {
    float first = above_cutoff(from), last = above_cutoff(to);
    vec2 kept = vec2(0.0, 1.0); // from where to where
    if (first < 0.0 && last < 0.0)
        return vec4(0.0);
    if (first < 0.0)
        kept.x = first / (first - last);
    if (last < 0.0)
        kept.y = first / (first - last);
    float share = kept.y - kept.x;
    return vec4(share * mix(from.rgb, to.rgb, 0.5 * (kept.x + kept.y)), share);
}

// The mean over a square from the colours of its corners, interpolated between them. Lines run
// along the steeper change of alpha.
vec4 kept_of_square(vec4 corner_00, vec4 corner_10, vec4 corner_01, vec4 corner_11) {
    vec2 change = vec2(corner_10.a + corner_11.a - corner_00.a - corner_01.a,
                       corner_01.a + corner_11.a - corner_00.a - corner_10.a);
    bool along_y = abs(change.y) > abs(change.x);
    vec4 right = along_y ? corner_01 : corner_10;
    vec4 below = along_y ? corner_10 : corner_01;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < LINES; ++i) {
        float place = (float(i) + 0.5) / float(LINES);
        sum += kept_of_line(mix(corner_00, below, place), mix(right, corner_11, place));
    }
    return sum / float(LINES);
}

// `place`: in texels from the map's corner.
vec4 colour_at(vec2 place) {
    return textureLod(base_colour_map, place / vec2(constants.width, constants.height), 0.0);
}

// The mean over a texel of what is kept.
vec4 kept_of_texel(ivec2 texel) {
    if (constants.interpolated == 0u) {
        vec4 colour = texelFetch(base_colour_map, texel, 0);
        return above_cutoff(colour) < 0.0 ? vec4(0.0) : vec4(colour.rgb, 1.0);
    }
    vec4 colours[9];
    for (int i = 0; i < 9; ++i)
        colours[i] = colour_at(vec2(texel) + 0.5 * vec2(i % 3, i / 3));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        int corner = 3 * (i / 2) + i % 2;
        sum += kept_of_square(colours[corner], colours[corner + 1], colours[corner + 3],
                              colours[corner + 4]);
    }
    return 0.25 * sum;
}

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(position, imageSize(coverage_map).xy)))
        return;
    ivec2 size = ivec2(constants.width, constants.height);
    vec3 column_weights = box_weights(size.x, position.x);
    vec3 row_weights = box_weights(size.y, position.y);
    vec4 mean = vec4(0.0);
    for (int y = 0; y < box_taps(size.y); ++y) {
        for (int x = 0; x < box_taps(size.x); ++x)
            mean += row_weights[y] * column_weights[x] *
                    kept_of_texel(2 * position + ivec2(x, y));
    }
    imageStore(coverage_map, ivec3(position, 0), mean);
}
