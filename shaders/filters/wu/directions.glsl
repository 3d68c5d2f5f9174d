#ifndef WU_DIRECTIONS_GLSL
#define WU_DIRECTIONS_GLSL

// Directions of the upper hemisphere as points of a square: equal areas are equal solid angles.
//
// Shirley, Chiu, 1997, A Low Distortion Map Between Disk and Square.

#include "lib/number/constants.glsl"

// `place` in [-1, 1].
vec3 direction_of_square(vec2 place) {
    float radius = max(abs(place.x), abs(place.y));
    float angle = 0.0;
    if (radius > 0.0)
        angle = abs(place.x) >= abs(place.y)
                    ? 0.25 * PI * place.y / place.x + (place.x < 0.0 ? PI : 0.0)
                    : 0.5 * PI - 0.25 * PI * place.x / place.y + (place.y < 0.0 ? PI : 0.0);
    return vec3(radius * sqrt(2.0 - radius * radius) * vec2(cos(angle), sin(angle)),
                1.0 - radius * radius);
}

vec2 square_of_direction(vec3 direction) {
    float radius = sqrt(clamp(1.0 - direction.z, 0.0, 1.0));
    if (direction.x == 0.0 && direction.y == 0.0)
        return vec2(0.0);
    float quarters = atan(direction.y, direction.x) * (4.0 / PI); // [-4, 4]
    if (abs(quarters) <= 1.0)
        return radius * vec2(1.0, quarters);
    if (abs(quarters) >= 3.0)
        return radius * vec2(-1.0, quarters > 0.0 ? 4.0 - quarters : -4.0 - quarters);
    return quarters > 0.0 ? radius * vec2(2.0 - quarters, 1.0)
                          : radius * vec2(2.0 + quarters, -1.0);
}

// The height of the lowest directions of a table.
float lowest_height(uint count) {
    float radius = 1.0 - 1.0 / float(count);
    return 1.0 - radius * radius;
}

// The middle of a square of `count` x `count`, row by row.
vec3 direction_of_index(uint index, uint count) {
    vec2 place = vec2(index % count, index / count) + 0.5;
    return direction_of_square(2.0 * place / float(count) - 1.0);
}

#endif
