#ifndef LIB_LAMBERT_PLANE_GLSL
#define LIB_LAMBERT_PLANE_GLSL

// Lambert, 1772, Anmerkungen und Zusaetze zur Entwerfung der Land- und Himmelscharten: the
// azimuthal projection that preserves areas. A direction at the angle theta from the pole
// (0, 0, 1) lies at |q| = 2 sin(theta / 2), dA = d omega; the hemisphere is a disc of radius
// sqrt(2), the sphere one of radius 2. A von Mises-Fisher lobe at the pole becomes a Gaussian of
// variance 1/kappa, exactly.

// Of a unit direction; the pole's opposite, which is a whole circle, goes to (2, 0).
vec2 plane_from_direction(vec3 direction) {
    float opposite = 1.0 + direction.z;
    if (opposite < 1e-6)
        return vec2(2.0, 0.0);
    return direction.xy * sqrt(2.0 / opposite);
}

// How far along each axis of the plane directions lie that have this one's slope along it: what is
// interpolated between directions has a slope between theirs, but its place may lie beyond theirs.
vec2 reach_from_direction(vec3 direction) {
    vec2 along = direction.xy;
    vec2 size = sqrt(along * along + direction.z * direction.z);
    vec2 square = size * (size + direction.z);
    return vec2(square.x < 1e-6 ? (along.x < 0.0 ? -2.0 : 2.0) * size.x
                                : along.x * sqrt(2.0 / square.x),
                square.y < 1e-6 ? (along.y < 0.0 ? -2.0 : 2.0) * size.y
                                : along.y * sqrt(2.0 / square.y));
}

// The unit direction of a place; beyond the disc, that of the nearest point on its rim.
vec3 direction_from_plane(vec2 place) {
    float square = min(dot(place, place), 4.0);
    return vec3(place * sqrt(max(1.0 - 0.25 * square, 0.0)), 1.0 - 0.5 * square);
}

// The displacement of a direction for a displacement of its place, to first order.
vec3 direction_step(vec2 place, vec2 step) {
    float height = sqrt(max(1.0 - 0.25 * dot(place, place), 0.05));
    float outward = dot(place, step);
    return vec3(height * step - place * (0.25 * outward / height), -outward);
}

// The covariance (xx, yy, xy) in the plane, at a direction's place, of an isotropic variance about
// it: the map shrinks by cos(theta / 2) outwards and stretches by 1 / cos(theta / 2) around. With c
// = cos^2(theta / 2) = 1 - |q|^2 / 4 and the unit vector r = q / |q|,
//   c r r^T + (1/c) (I - r r^T) = I/c - (1/c - c) q q^T / |q|^2,   |q|^2 = 4 (1 - c).
// Near the rim it is that of c = 0.05, to keep it bounded.
vec3 plane_distortion(vec2 place) {
    float square = dot(place, place);
    float c = max(1.0 - 0.25 * square, 0.05);
    float outward = (1.0 + c) / (c * max(4.0, square / 0.95));
    return vec3(1.0 / c - outward * place * place, -outward * place.x * place.y);
}

#endif
