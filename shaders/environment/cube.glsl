#ifndef ENVIRONMENT_CUBE_GLSL
#define ENVIRONMENT_CUBE_GLSL

// The mean radiance of an environment's image over the solid angle of a cube's texel.

#include "interface/environment/environment.h"
#include "lib/light/cube_texel.glsl"
#include "lib/light/latitude_longitude.glsl"

layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1) readonly buffer places_block { environment_face_place places[6]; };
layout(set = 0, binding = 2) uniform writeonly image2DArray cube;

layout(push_constant) uniform constants_block { environment_cube_constants constants; };

// Between the rows next to a pole, where a row's solid angle grows with its distance from the pole,
// linear interpolation shifts energy across the boundary, w^2/6 of a texel for a transition of
// half-width w. With w growing by 1/16 a row no row gains or loses more than 1/768 of its energy.
const float TRANSITION_GROWTH = 1.0 / 16.0;

// Moves a position so that bilinear interpolation between two rows blends over this width only.
float position_between_rows(float position, float rows) {
    float boundary = round(position);
    float from_pole = min(boundary, rows - boundary);
    float half_width = clamp(TRANSITION_GROWTH * from_pole, 1e-3, 0.5);
    return boundary + clamp(0.5 * (position - boundary) / half_width, -0.5, 0.5);
}

// Mean over the longitudes around a subsample, which are many columns near the poles. The weights
// fall to zero at the neighbouring subsamples, so that no column is missed, however narrow.
vec3 radiance_at_latitude(vec3 direction, float size) {
    vec2 extent = vec2(textureSize(image, 0));
    vec2 position = latitude_longitude(direction);
    position.y = position_between_rows(position.y * extent.y, extent.y) / extent.y;
    vec3 base = textureLod(image, position, 0.0).rgb;
    float sine = length(direction.xz) * inversesqrt(dot(direction, direction));
    float turn = min(size / max(2.0 * PI * sine, 1e-6), 0.5);
    int reach = int(2.0 * turn * extent.x);
    vec4 sum = vec4(vec3(0.0), 1.0);
    for (int i = 1; i <= reach; ++i) {
        float part = float(i) / float(reach + 1);
        for (int side = -1; side <= 1; side += 2) {
            vec2 beside = vec2(position.x + float(side) * part * turn, position.y);
            sum += (1.0 - part) * vec4(textureLod(image, beside, 0.0).rgb - base, 1.0);
        }
    }
    return base + sum.rgb / sum.a;
}

vec3 radiance_on_face(int face, vec2 point) {
    environment_face_place place = places[face];
    vec2 corner = place.origin.xy - abs(place.right_down.xy) - abs(place.right_down.zw);
    vec2 position =
        place.origin.xy + point.x * place.right_down.xy + point.y * place.right_down.zw;
    // Texels of the neighbouring face on the image must not leak in.
    position = clamp(position, corner + 0.5, corner + float(constants.face_texels) - 0.5);
    if (constants.nearest != 0u)
        position = floor(position) + 0.5;
    return textureLod(image, position / vec2(textureSize(image, 0)), 0.0).rgb;
}

vec3 radiance(int face, vec2 point, float size) {
    return constants.latitude_longitude != 0u
               ? radiance_at_latitude(cube_direction(face, point), size)
               : radiance_on_face(face, point);
}

const int LEAST_SUBSAMPLES = 4;
const float MOST_POLAR_SUBSAMPLES = 6.0;

// How many times as narrow as elsewhere the transitions between rows are around a texel. It changes
// gradually: where the numbers of subsamples of neighbouring texels differ, the energy of what lies
// between them is less accurate.
float narrowness_of_transitions(float sine) {
    float rows = asin(min(sine, 1.0)) * INVERSE_PI * float(constants.face_texels);
    float reach = 3.0 / float(constants.size) * INVERSE_PI * float(constants.face_texels);
    return clamp(1.0 / (TRANSITION_GROWTH * max(rows - reach, 1.0)), 1.0, MOST_POLAR_SUBSAMPLES);
}

// Seen from the centre, texels shrink towards the edges of a face, and need fewer subsamples of
// latitude and longitude there; next to the poles, where rows have narrow transitions, they need
// more.
int subsample_count(int face, vec2 centre) {
    int count = int(constants.subsamples);
    if (constants.latitude_longitude == 0u)
        return constants.nearest != 0u ? count : max(count, LEAST_SUBSAMPLES);
    vec3 direction = cube_direction(face, centre);
    float shrinking = inversesqrt(dot(direction, direction));
    count = max(int(ceil(float(count) * shrinking)), LEAST_SUBSAMPLES);
    // Where the cube is finer than the image, the least number is more than rows need already. They
    // get twice what they need, because a sun in the first row may lie within one transition.
    float rows = 2.0 / float(constants.size) * INVERSE_PI * float(constants.face_texels);
    float enough = 2.0 * float(ENVIRONMENT_SUBSAMPLES) / float(LEAST_SUBSAMPLES);
    float needed = min(rows * shrinking * enough, 1.0);
    float narrowness = narrowness_of_transitions(length(direction.xz) * shrinking);
    return max(count, int(ceil(float(count) * narrowness * needed)));
}

// Points of a texel in [0, 1]^2: a grid where the image has an equally fine one, otherwise a
// Fibonacci lattice (Zaremba, 1966, Good Lattice Points, Discrepancy, and Numerical Integration).
// The lattice continues from texel to texel as a grid does, but has no rows that could alias with
// the image's: sums over the hats of bilinear interpolation are accurate to a thousandth.
struct point_set {
    int count, step; // step: that of the lattice; 0: a grid
    int side;        // of the grid
};

point_set points_for(int side) {
    if (constants.nearest != 0u)
        return point_set(side * side, 0, side);
    ivec2 numbers = ivec2(5, 8);
    while (numbers.y < side * side)
        numbers = ivec2(numbers.y, numbers.x + numbers.y);
    return point_set(numbers.y, numbers.x, 0);
}

vec2 point_at(point_set set, int i) {
    if (set.step == 0)
        return (vec2(i % set.side, i / set.side) + 0.5) / float(set.side);
    return (vec2(i, uint(i) * uint(set.step) % uint(set.count)) + 0.5) / float(set.count);
}

// Of a texel's points, every `step`-th from `first` on: the sum of their radiance times weight, and
// of their weights. Radiance relative to that of point 0, the `base`: so a constant is reproduced
// exactly.
vec4 sum_of_points(ivec3 texel, int first, int step, out vec3 base) {
    int size = int(constants.size);
    float extent = 2.0 / float(size);
    vec2 low = vec2(2 * texel.xy - size) / float(size);
    point_set set = points_for(subsample_count(texel.z, low + 0.5 * extent));
    float spacing = extent * inversesqrt(float(set.count));
    base = radiance(texel.z, low + extent * point_at(set, 0), spacing);
    vec4 sum = vec4(0.0);
    for (int i = first; i < set.count; i += step) {
        vec2 point = low + extent * point_at(set, i);
        float shrinking = inversesqrt(1.0 + dot(point, point));
        float weight = shrinking * shrinking * shrinking;
        sum += weight * vec4(radiance(texel.z, point, spacing * shrinking) - base, 1.0);
    }
    return sum;
}

void store_mean(ivec3 texel, vec3 base, vec4 sum) {
    imageStore(cube, texel, vec4(base + sum.rgb / sum.a, 1.0));
}

#endif
