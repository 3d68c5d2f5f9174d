#ifndef LIB_CUBE_TEXEL_GLSL
#define LIB_CUBE_TEXEL_GLSL

// Texels of a cube map: their directions and solid angles.

// Khronos Group, 2023, Vulkan 1.3 Specification, "Cube Map Face Selection", inverted: the direction
// of a face's point, each coordinate in [-1, 1] with y down, on the cube itself. Faces in the order
// +X -X +Y -Y +Z -Z.
vec3 cube_direction(int face, vec2 point) {
    switch (face) {
    case 0:
        return vec3(1.0, -point.y, -point.x);
    case 1:
        return vec3(-1.0, -point.y, point.x);
    case 2:
        return vec3(point.x, 1.0, point.y);
    case 3:
        return vec3(point.x, -1.0, -point.y);
    case 4:
        return vec3(point.x, -point.y, 1.0);
    default:
        return vec3(-point.x, -point.y, -1.0);
    }
}

// Unit direction of a texel's centre, on faces of size x size texels.
vec3 cube_texel_direction(int face, ivec2 texel, int size) {
    return normalize(cube_direction(face, vec2(2 * texel + 1 - size) / float(size)));
}

// The next texel of a face's row, or the first of the next row or face; z: the face.
ivec3 next_cube_texel(ivec3 texel, int size) {
    texel.x += 1;
    if (texel.x == size)
        texel = ivec3(0, texel.y + 1, texel.z);
    return texel.y == size ? ivec3(0, 0, texel.z + 1) : texel;
}

// arctan(tangent) for a tangent in [0, 1/sqrt(3)], relative error 2.5e-8 (Remez). Vulkan allows a
// driver's own an error of 4096 units in the last place.
float arctangent_of_small(float tangent) {
    float u = tangent * tangent;
    float series = -0.333329886 +
                   u * (0.19984737 + u * (-0.140633807 + u * (0.0964743644 - u * 0.0432608202)));
    return tangent + tangent * u * series;
}

// Steradians of the square from `low` to `low` + `extent` of a face, each coordinate in [-1, 1].
//
// Van Oosterom, Strackee, 1983, The Solid Angle of a Plane Triangle, Eq. 8: for corners a, b, c
//   tan(Omega/2) = det(a, b, c) / (|a||b||c| + <a,b>|c| + <b,c>|a| + <c,a>|b|)
// where the determinant is extent^2 for either half of the square, and the two tangents t_1, t_2
// add up to (t_1 + t_2)/(1 - t_1 t_2). Nothing cancels, unlike in the difference of four
// arctangents at the corners, which leaves no digit of a texel of a 2048-wide face.
float cube_solid_angle(vec2 low, float extent) {
    vec3 a = vec3(low, 1.0), c = vec3(low + extent, 1.0);
    vec3 b = vec3(c.x, a.y, 1.0), d = vec3(a.x, c.y, 1.0);
    float diagonal = length(a) * length(c), cosine = dot(a, c);
    float first = (diagonal + cosine) * length(b) + dot(a, b) * length(c) + dot(b, c) * length(a);
    float second = (diagonal + cosine) * length(d) + dot(c, d) * length(a) + dot(d, a) * length(c);
    float area = extent * extent;
    float tangent_of_half = area * (first + second) / (first * second - area * area);
    float tangent_of_quarter =
        tangent_of_half / (1.0 + sqrt(1.0 + tangent_of_half * tangent_of_half));
    return 4.0 * arctangent_of_small(tangent_of_quarter);
}

// Steradians of a texel, on faces of size x size texels. A face has 2 pi/3.
float cube_texel_solid_angle(ivec2 texel, int size) {
    return cube_solid_angle(vec2(2 * texel - size) / float(size), 2.0 / float(size));
}

#endif
