#ifndef LIB_SPHERICAL_CAP_GLSL
#define LIB_SPHERICAL_CAP_GLSL

// Which texels of a cube's face lie in a cap, the directions that are at most an angle r away from
// an axis. On the face's plane, whose points are (x, y, 1), the cap is inside a conic.

struct spherical_cap {
    vec3 axis; // unit, in the face's own frame: see cube_face_coordinates
    float sine, cosine; // of r; the cosine may be negative
};

// The direction's coordinates (x, y, depth) on a face: the inverse of cube_direction() for depth 1.
vec3 cube_face_coordinates(int face, vec3 direction) {
    switch (face) {
    case 0:
        return vec3(-direction.z, -direction.y, direction.x);
    case 1:
        return vec3(direction.z, -direction.y, -direction.x);
    case 2:
        return vec3(direction.x, direction.z, direction.y);
    case 3:
        return vec3(direction.x, -direction.z, -direction.y);
    case 4:
        return vec3(direction.x, -direction.y, direction.z);
    default:
        return vec3(-direction.x, -direction.y, -direction.z);
    }
}

const vec2 NOTHING = vec2(2.0, -2.0); // an interval from its low to its high end
const vec2 WHOLE_FACE = vec2(-1.0, 1.0);

// Rows that the cap may reach. Seen along x, the axis is at the angle a = atan2(axis.y, axis.z),
// and the cap reaches from a - b to a + b where sin b = sin r / |(axis.y, axis.z)|.
vec2 cap_rows(spherical_cap cap) {
    float square = dot(cap.axis.yz, cap.axis.yz), rest = square - cap.sine * cap.sine;
    if (cap.cosine <= 0.0 || rest <= 0.0)
        return WHOLE_FACE;
    float cosine = sqrt(rest);
    // Sine and cosine of both ends, times |(axis.y, axis.z)|^2.
    vec2 low = vec2(cap.axis.y * cosine - cap.axis.z * cap.sine,
                    cap.axis.z * cosine + cap.axis.y * cap.sine);
    vec2 high = vec2(cap.axis.y * cosine + cap.axis.z * cap.sine,
                     cap.axis.z * cosine - cap.axis.y * cap.sine);
    // An end behind the face's plane is beyond the face's own end, or the whole cap is.
    if ((low.y <= 0.0 && cap.axis.y >= 0.0) || (high.y <= 0.0 && cap.axis.y < 0.0))
        return NOTHING;
    return vec2(low.y > 0.0 ? low.x / low.y : -1.0, high.y > 0.0 ? high.x / high.y : 1.0);
}

// Columns of the row at y that the cap reaches: where
//   axis.x x + e >= cos r sqrt(x^2 + q),  e = axis.y y + axis.z,  q = y^2 + 1.
vec2 cap_columns(spherical_cap cap, float y) {
    if (cap.cosine <= 0.0)
        return WHOLE_FACE;
    float e = cap.axis.y * y + cap.axis.z, q = y * y + 1.0;
    float square = cap.cosine * cap.cosine;
    float leading = square - cap.axis.x * cap.axis.x; // above 0: the row leaves the cap both ways
    float discriminant = e * e - q * leading;
    if (discriminant <= 0.0)
        return NOTHING;
    float root = cap.cosine * sqrt(discriminant), middle = cap.axis.x * e;
    if (leading > 0.0)
        return e > 0.0 ? (middle + vec2(-root, root)) / leading : NOTHING;
    if (leading == 0.0)
        return WHOLE_FACE;
    return cap.axis.x > 0.0 ? vec2((middle - root) / leading, 1.0)
                            : vec2(-1.0, (middle + root) / leading);
}

// First and last texel of a row, or row of a face, of `size` texels whose centres lie in an
// interval; if there is none, the first is beyond the last.
ivec2 texels_between(vec2 interval, int size) {
    vec2 ends = 0.5 * (clamp(interval, -2.0, 2.0) * float(size) + float(size - 1));
    return clamp(ivec2(int(ceil(ends.x)), int(floor(ends.y))), ivec2(0, -1), ivec2(size, size - 1));
}

#endif
