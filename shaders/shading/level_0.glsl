#ifndef LEVEL_0_GLSL
#define LEVEL_0_GLSL

// Level 0 of the maps under a pixel that is about as large as a texel: the base material itself.
// Normals that are interpolated between texels turn inside the pixel, which widens the lobes about
// them; less and less as the map is magnified.

#include "shading/colours/filtered_material.glsl"
#include "lib/lobe/characteristic_vector.glsl"
#include "lib/lobe/direction_lobe.glsl"

layout(constant_id = SPECIALISE_INTERPOLATED) const bool INTERPOLATED = false;

// Normals of level 0 over the pixel's box; under a mask, those that it keeps.
struct level_0_normals {
    vec3 mean;      // at most of unit length
    float variance; // (1 - |mean|)/|mean|, as variance_of_mean_normal
    float kept;     // [0, 1]: the part that a mask keeps
    // The direction in which they vary most, and by how much more, as in base_material.
    vec3 direction;
    float uneven;
};

level_0_normals one_normal(vec3 normal, float kept) {
    return level_0_normals(normal, 0.0, kept, vec3(0.0), 0.0);
}

// `first` and `second` are deviations: half of a covariance each.
void take_directions(inout level_0_normals normals, vec3 first, vec3 second) {
    vec3 axis = mean_direction(normals.mean, vec3(0.0, 0.0, 1.0));
    direction_lobe lobe = principal_lobe(
        direction_lobe(axis, first - axis * dot(axis, first), second - axis * dot(axis, second)));
    float most = dot(lobe.first, lobe.first), least = dot(lobe.second, lobe.second);
    normals.direction = lobe.first * inversesqrt(max(most, 1e-20));
    // Of normals that do not change evenly, three are seldom spread alike to all sides: only what
    // hardly varies across counts as long.
    float uneven = (most - least) / max(most + least, 1e-20);
    normals.uneven = uneven * uneven * uneven * uneven;
}

// The part that level 0 has of a footprint's appearance; the maps have the rest. Under a mask each
// counts by what it keeps: a pixel that shows a part of the surface may have a hole at its centre.
// `filtered`: the maps' part of the area. `kept`: how much the maps' texels count.
float share_of_level_0(level_0_normals normals, float filtered, float kept) {
    if (!may_see_level_0(lobe_map()))
        return 0.0;
    float share = 1.0 - filtered;
    return MASKED_LOBES && share > 0.0
               ? share * normals.kept / max(mix(kept, normals.kept, share), 1e-6)
               : share;
}

// One where the mask keeps a point, else zero.
float kept_at(surface_point surface, vec2 coordinates) {
    return !MASKED_LOBES || is_kept(base_texel(base_colour_map, coordinates).a, surface) ? 1.0
                                                                                          : 0.0;
}

// The map's normal at texture coordinates, with slopes multiplied by `relief`.
vec3 level_0_normal(surface_point surface, vec2 coordinates, float relief) {
    return stretched_normal(decode_normal(textureLod(normal_map, coordinates, 0.0).xyz,
                                          material.normal_scale * relief, NORMALS), surface);
}

// Three points that have the mean and the covariance of all of the pixel's points if normals change
// linearly: over a box of width one, whose variance is 1/12, the corners of an equilateral triangle
// at the distance 1/sqrt(6) from its centre. Where level 0 has no share, the surface's own normal.
// Beyond the edges of a clamped map, pixels of any size show level 0. Of so many normals, three far
// apart are not the mean and the covariance: the box is two texels wide there.
level_0_normals normals_of_level_0(surface_point surface, map_area area, float relief) {
    if (!may_see_level_0(lobe_map()) || area.share >= 1.0)
        return one_normal(vec3(0.0, 0.0, 1.0), 1.0);
    vec2 centre = map_coordinates(lobe_map(), surface.coordinates, 1.0);
    if (!has_map(MAP_NORMAL))
        return one_normal(vec3(0.0, 0.0, 1.0), kept_at(surface, centre));
    if (!INTERPOLATED)
        return one_normal(level_0_normal(surface, centre, relief), kept_at(surface, centre));
    float part = CLAMPED_MAPS != 0u ? exp2(-max(area.level - 1.0, 0.0)) : 1.0;
    vec2 dx = map_coordinates(MAP_NORMAL, surface.coordinates_dx, 0.0) * part * inversesqrt(8.0);
    vec2 dy = map_coordinates(MAP_NORMAL, surface.coordinates_dy, 0.0) * part * inversesqrt(6.0);
    vec2 points[3] = vec2[](centre + dy, centre + dx - 0.5 * dy, centre - dx - 0.5 * dy);
    vec3 a = level_0_normal(surface, points[0], relief);
    vec3 b = level_0_normal(surface, points[1], relief);
    vec3 c = level_0_normal(surface, points[2], relief);
    vec3 kept = vec3(kept_at(surface, points[0]), kept_at(surface, points[1]),
                     kept_at(surface, points[2]));
    float scale = 1.0 / max(kept.x + kept.y + kept.z, 1.0);
    vec3 mean = scale * (kept.x * a + kept.y * b + kept.z * c);
    // 1 - |mean|^2, which would cancel.
    float complement = scale * dot(kept, vec3(difference_squared(a, mean),
                                              difference_squared(b, mean),
                                              difference_squared(c, mean)));
    float length = max(length(mean), 1e-4);
    level_0_normals normals = one_normal(mean, dot(kept, vec3(1.0 / 3.0)));
    normals.variance = complement / ((1.0 + length) * length);
    // The covariance of three points by two differences.
    float others = max(kept.y + kept.z, 1.0);
    take_directions(normals, sqrt(scale * kept.y * kept.z / others) * (b - c),
                    sqrt(scale * kept.x * (1.0 + kept.x / others)) * (a - mean));
    return normals;
}

// `normals`: of level 0.
base_material level_0_material(surface_point surface, level_0_normals normals) {
    base_material base =
        unfiltered_material(surface,
                            facing_normal(mean_direction(normals.mean, vec3(0.0, 0.0, 1.0)),
                                          surface));
    base.variance += normals.variance;
    base.direction = normals.direction;
    base.uneven =
        INTERPOLATED ? normals.uneven * normals.variance / max(base.variance, 1e-20) : 0.0;
    take_width(base, surface);
    return base;
}

#endif
