#ifndef LIB_OCTAHEDRON_GLSL
#define LIB_OCTAHEDRON_GLSL

// Directions on a square: the sphere is projected to the octahedron |x| + |y| + |z| = 1, whose
// lower half is folded outwards. Meyer, Suessmuth, Sussner, Stamminger, Greiner, 2010, On
// Floating-Point Normal Vectors, section 3. Continuous everywhere but at the square's edge, where
// each half of a side meets the other half.

// [-1, 1]^2 for a direction of any length but 0.
vec2 octahedron_place(vec3 direction) {
    vec3 d = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    vec2 folded = (1.0 - abs(d.yx)) * vec2(d.x < 0.0 ? -1.0 : 1.0, d.y < 0.0 ? -1.0 : 1.0);
    return d.z < 0.0 ? folded : d.xy;
}

// The unit direction. Places up to 1 beyond the edge continue on the other half of the side.
vec3 octahedron_direction(vec2 place) {
    vec2 p = place;
    if (abs(p.x) > 1.0)
        p = vec2(sign(p.x) * 2.0 - p.x, -p.y);
    if (abs(p.y) > 1.0)
        p = vec2(-p.x, sign(p.y) * 2.0 - p.y);
    vec3 d = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (d.z < 0.0)
        d.xy = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return normalize(d);
}

// Texture coordinates on a map of size x size texels with a border of one texel around it.
vec2 octahedron_coordinates(vec3 direction, float size) {
    return ((0.5 * octahedron_place(direction) + 0.5) * size + 1.0) / (size + 2.0);
}

// The direction of a texel of such a map, border included.
vec3 octahedron_texel_direction(ivec2 texel, int size) {
    return octahedron_direction((2.0 * vec2(texel) - 1.0) / float(size) - 1.0);
}

#endif
