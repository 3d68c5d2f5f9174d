#ifndef TARGET_POINTS_GLSL
#define TARGET_POINTS_GLSL

// The points of the base maps of which a texel of a finest level is the mean.

#include "lib/map/box_reduction.glsl"
#include "maps/map_points.glsl"

// All points of the texels under one.
struct target_points {
    ivec2 size;  // of the base maps
    ivec2 first; // of their texels
    ivec2 taps;
    vec3 column_weights, row_weights;
};

struct target_point {
    vec2 place;   // in the coordinates of all maps
    float weight; // of all, the sum is 1
    int index;
};

target_points points_under(ivec2 position, ivec2 size) {
    return target_points(size, 2 * position, ivec2(box_taps(size.x), box_taps(size.y)),
                         box_weights(size.x, position.x), box_weights(size.y, position.y));
}

int texel_count(target_points points) {
    return points.taps.x * points.taps.y;
}

// The column and row of a texel, which are numbered row by row.
ivec2 texel_of(target_points points, int texel) {
    // Without a division, of which lavapipe makes one for each invocation.
    int row = int(texel >= points.taps.x) + int(texel >= 2 * points.taps.x);
    return ivec2(texel - row * points.taps.x, row);
}

int count_of(target_points points) {
    return texel_count(points) * POINTS;
}

// `index`: less than count_of(points); all points of a texel one after the other.
target_point point_of(target_points points, int index) {
    ivec2 texel = texel_of(points, index / POINTS);
    float weight = points.row_weights[texel.y] * points.column_weights[texel.x] / float(POINTS);
    return target_point(map_point(points.first + texel, index % POINTS, points.size), weight,
                        index);
}

#endif
