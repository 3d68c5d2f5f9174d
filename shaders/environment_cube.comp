#version 460
#extension GL_GOOGLE_include_directive : require

// The six faces of an environment from its image: each texel is the mean radiance over its solid
// angle, of many subsamples that are a quarter of the image's texels apart at most. Energy is kept
// to a thousandth, wherever on the image it lies.

#include "interface/environment.h"
#include "lib/cube_texel.glsl"
#include "lib/latitude_longitude.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1) readonly buffer places_block { environment_face_place places[6]; };
layout(set = 0, binding = 2) uniform writeonly image2DArray cube;

layout(push_constant) uniform constants_block { environment_cube_constants constants; };

// Between the rows next to a pole, where a row's solid angle grows with its distance from the pole,
// linear interpolation shifts energy across the boundary, w^2/6 of a texel for a transition of
// half-width w. With w growing by 1/16 a row no row gains or loses more than 1/768 of its energy.
const float TRANSITION_GROWTH = 1.0 / 16.0;

// Moves a position so that bilinear interpolation has its transition between two rows in this width.
float position_between_rows(float position, float rows) {
    float boundary = round(position);
    float from_pole = min(boundary, rows - boundary);
    float half_width = clamp(TRANSITION_GROWTH * from_pole, 1e-3, 0.5);
    return boundary + clamp(0.5 * (position - boundary) / half_width, -0.5, 0.5);
}

// Mean over the longitudes around a subsample, near the poles many columns, with weights that fall
// to nothing at the neighbouring subsamples: however narrow a column is, none is missed.
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
    // No texel of a neighbour on the image may come in.
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

const int LEAST_SUBSAMPLES = 4, POLAR_SUBSAMPLES = 4;

// Seen from within, texels shrink towards the edges of a face, and need fewer subsamples of latitude
// and longitude there; next to the poles, where rows have narrow transitions, they need more.
int subsample_count(int face, vec2 centre) {
    int count = int(constants.subsamples);
    if (constants.latitude_longitude == 0u)
        return constants.nearest != 0u ? count : max(count, LEAST_SUBSAMPLES);
    vec3 direction = cube_direction(face, centre);
    float shrinking = inversesqrt(dot(direction, direction));
    count = max(int(ceil(float(count) * shrinking)), LEAST_SUBSAMPLES);
    float polar = 0.5 / TRANSITION_GROWTH * PI / float(constants.face_texels) +
                  1.5 / float(constants.size);
    return length(direction.xz) * shrinking < polar ? POLAR_SUBSAMPLES * count : count;
}

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    int size = int(constants.size);
    if (any(greaterThanEqual(position.xy, ivec2(size))))
        return;
    vec2 low = vec2(2 * position.xy - size) / float(size);
    int count = subsample_count(position.z, low + 1.0 / float(size));
    float extent = 2.0 / float(size * count);
    // Means are taken of differences to one of the values: a constant stays exactly what it is.
    vec3 base = radiance(position.z, low + 0.5 * extent, extent);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < count; ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < count; ++x) {
            vec2 corner = low + extent * vec2(x, y);
            vec2 centre = corner + 0.5 * extent;
            float shrinking = inversesqrt(1.0 + dot(centre, centre));
            float weight = shrinking * shrinking * shrinking;
            row += weight * vec4(radiance(position.z, centre, extent * shrinking) - base, 1.0);
        }
        sum += row;
    }
    imageStore(cube, position, vec4(base + sum.rgb / sum.a, 1.0));
}
