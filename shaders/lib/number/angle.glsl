#ifndef LIB_ANGLE_GLSL
#define LIB_ANGLE_GLSL

// Half vector of two unit directions; zero if they are opposite.
vec3 half_vector(vec3 a, vec3 b) {
    vec3 sum = a + b;
    float square = dot(sum, sum);
    return square > 0.0 ? sum * inversesqrt(square) : vec3(0.0);
}

// Angles between unit vectors through their difference: with d = |a - b|^2,
//   cos = 1 - d/2,   sin^2 = d (1 - d/4).
// The difference of close vectors is exact in floating point, while 1 - <a,b> and the cross
// product lose all digits below an angle of 1e-4.
float difference_squared(vec3 a, vec3 b) {
    vec3 difference = a - b;
    return dot(difference, difference);
}

float sine_squared_between(vec3 a, vec3 b) {
    float d = difference_squared(a, b);
    return d * max(1.0 - 0.25 * d, 0.0);
}

#endif
