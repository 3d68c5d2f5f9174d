#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a masked material's colours: the colour of what the mask keeps, times the
// share of the texel that it keeps. The mask is a threshold, so the mean of what it keeps is not
// what a threshold keeps of the mean.
//
// Where the map is interpolated, so is its alpha before it meets the cutoff. Between four texel
// centres it is bilinear: linear along a line, of which the part above the cutoff is exact.
//
// A layer for each of the thresholds, where these differ over the meshes.

#include "interface/colours/mask.h"
#include "lib/map/box_reduction.glsl"
#include "lib/number/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D base_colour_map;
layout(set = 0, binding = 1) uniform writeonly image2DArray coverage_map;

layout(push_constant) uniform constants_block { mask_constants constants; };

// Lines in each quarter of a texel.
const int LINES = 4;

// Of this layer's alpha.
float alpha_factor() {
    uint layer = gl_GlobalInvocationID.z;
    return layer == 0u ? constants.alpha
                       : constants.cutoff / (constants.cutoff / constants.alpha +
                                             constants.step * float(layer));
}

// Above 0 or equal: kept.
float above_cutoff(vec4 colour) {
    return colour.a * alpha_factor() - constants.cutoff;
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
    vec4 above = vec4(above_cutoff(corner_00), above_cutoff(corner_10), above_cutoff(corner_01),
                      above_cutoff(corner_11));
    bool all_kept = all(greaterThanEqual(above, vec4(0.0)));
    bool along_y = abs(above.z + above.w - above.x - above.y) >
                   abs(above.y + above.w - above.x - above.z);
    vec4 right = along_y ? corner_01 : corner_10;
    vec4 below = along_y ? corner_10 : corner_01;
    // Most squares need no lines.
    int lines = all_kept || all(lessThan(above, vec4(0.0))) ? 0 : LINES;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < lines; ++i) {
        float place = (float(i) + 0.5) / float(LINES);
        sum += kept_of_line(mix(corner_00, below, place), mix(right, corner_11, place));
    }
    vec4 mean = vec4(0.25 * (corner_00 + corner_10 + corner_01 + corner_11).rgb, 1.0);
    return all_kept ? mean : sum / float(LINES);
}

// One step outside the map, the texel on the other side or the same again.
int wrapped(int texel, int size, bool repeats) {
    return repeats ? (texel + size) % size : clamp(texel, 0, size - 1);
}

vec4 texel_at(ivec2 texel) {
    ivec2 inside = ivec2(wrapped(texel.x, int(constants.width), constants.repeats_u != 0u),
                         wrapped(texel.y, int(constants.height), constants.repeats_v != 0u));
    return finite_or_zero(texelFetch(base_colour_map, inside, 0));
}

// The interpolated map at a texel's left and right edge (0, 2) and in the middle, on three rows.
void read_columns(ivec2 texel, out vec4 rows[3][3]) {
    for (int y = 0; y < 3; ++y) {
        vec4 middle = texel_at(texel + ivec2(0, y - 1));
        rows[y][0] = 0.5 * (texel_at(texel + ivec2(-1, y - 1)) + middle);
        rows[y][1] = middle;
        rows[y][2] = 0.5 * (texel_at(texel + ivec2(1, y - 1)) + middle);
    }
}

// The mean over a texel of what is kept.
vec4 kept_of_texel(ivec2 texel) {
    if (constants.interpolated == 0u) {
        vec4 colour = finite_or_zero(texelFetch(base_colour_map, texel, 0));
        return above_cutoff(colour) < 0.0 ? vec4(0.0) : vec4(colour.rgb, 1.0);
    }
    vec4 rows[3][3];
    read_columns(texel, rows);
    vec4 sum = vec4(0.0);
    for (int x = 0; x < 2; ++x) {
        vec4 left = rows[1][x], right = rows[1][x + 1];
        sum += kept_of_square(0.5 * (rows[0][x] + left), 0.5 * (rows[0][x + 1] + right), left,
                              right);
        sum += kept_of_square(left, right, 0.5 * (rows[2][x] + left),
                              0.5 * (rows[2][x + 1] + right));
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
    imageStore(coverage_map, ivec3(position, gl_GlobalInvocationID.z), mean);
}
