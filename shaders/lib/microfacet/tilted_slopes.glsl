#ifndef LIB_TILTED_SLOPES_GLSL
#define LIB_TILTED_SLOPES_GLSL

// Slopes over a plane and slopes over the tilted plane whose own slope is m. With N^2 = 1 + m^2 and
// the symmetric matrix B = N I - m m^T/(N + 1), whose eigenvalues are 1 along m and N across it, a
// slope s over the first plane is
//   s' = B (s - m) / (1 + <s, m>)
// over the second: the tangent of a difference of angles along m. To first order about m that is
// s' = B/N^2 (s - m), and its inverse s - m = N B^-1 N s', where (N^2 B^-1)^2 = N^2 (I + m m^T).

// B/N^2 as (xx, yy, xy): brings a small difference of slopes to the tilted plane.
vec3 tilted_from_flat_slopes(vec2 tilt) {
    float square = 1.0 + dot(tilt, tilt);
    float n = sqrt(square);
    vec3 outer = vec3(tilt * tilt, tilt.x * tilt.y);
    return (vec3(n, n, 0.0) - outer / (n + 1.0)) / square;
}

// Its inverse, N^2 B^-1 = N (I + m m^T/(N + 1)).
vec3 flat_from_tilted_slopes(vec2 tilt) {
    float n = sqrt(1.0 + dot(tilt, tilt));
    return n * (vec3(1.0, 1.0, 0.0) + vec3(tilt * tilt, tilt.x * tilt.y) / (n + 1.0));
}

// A slope times one of these matrices.
vec2 transformed_slope(vec3 symmetric, vec2 slope) {
    return vec2(symmetric.x * slope.x + symmetric.z * slope.y,
                symmetric.z * slope.x + symmetric.y * slope.y);
}

// Covariance over the flat plane of slopes that have the same variance each way over the tilted
// one: variance N^2 (I + m m^T).
vec3 flat_covariance_of_tilted(vec2 tilt, float variance) {
    float scaled = variance * (1.0 + dot(tilt, tilt));
    return scaled * vec3(1.0 + tilt * tilt, tilt.x * tilt.y);
}

#endif
