#ifndef PATCH_CULLING_GLSL
#define PATCH_CULLING_GLSL

// Which patches may be in the picture, or throw shadows into it: by spheres around what the heights
// under them can displace, and by the steepest of their slopes.
//
// What is not drawn, but nearly, counts in part where room is shared out: from nothing, where it is
// this part of its radius away, to 1, where it is drawn. Otherwise the distance of all vertices
// would jump whenever a patch enters the picture.
const float NEARLY = 0.25;

// Of what is drawn if `inside` is not negative.
float presence_at(float inside, float radius) {
    return clamp(1.0 + inside / max(NEARLY * radius, 1e-30), 0.0, 1.0);
}

#include "displacement/height_bounds.glsl"
#include "displacement/patches.glsl"

// ---------------------------------------------------------------------------------------------
// The picture

float presence_in_picture(vec3 centre, float radius) {
    float inside = 1e30;
    for (int i = 0; i < 5; ++i)
        inside = min(inside, dot(constants.planes[i], vec4(centre, 1.0)) + radius);
    return presence_at(inside, radius);
}

// A shadow is the sphere moved along the light, and grows if the light is near: whether it is
// inside of all planes at the same time.
bool is_shadow_in_picture(vec4 caster, vec3 centre, float radius) {
    vec3 along = caster.w > 0.0 ? centre - caster.xyz : caster.xyz;
    float from = 0.0, to = 1e30;
    for (int i = 0; i < 5; ++i) {
        float inside = dot(constants.planes[i], vec4(centre, 1.0)) + radius;
        float change = dot(constants.planes[i].xyz, along) + caster.w * radius;
        if (change > 0.0)
            from = max(from, -inside / change);
        else if (change < 0.0)
            to = min(to, -inside / change);
        else if (inside < 0.0)
            return false;
    }
    return from <= to;
}

bool has_shadow_in_picture(vec3 centre, float radius) {
    if (constants.caster_count > PATCH_CASTERS)
        return true;
    for (uint i = 0u; i < constants.caster_count; ++i)
        if (is_shadow_in_picture(constants.casters[i], centre, radius))
            return true;
    return false;
}

// ---------------------------------------------------------------------------------------------
// Heights

// On seams, places have heights of other charts, too.
bool is_at_seam(uint triangle) {
    bool result = false;
    for (int i = 0; i < 3; ++i) {
        base_edge edge = edges[triangles[triangle].edges[i]];
        result = result || edge.pair_count > 1u ||
                 base_points[point_of_corner(triangle, i)].chart_count > 1u;
    }
    return result;
}

// Vertices have means over squares as wide as they are apart, interpolated between them: texels
// reach as far again, and again to the next level.
const float REACH_OF_MEANS = 3.0;

float farthest_reach() {
    return abs(constants.relief) * constants.stretch;
}

// Metres between vertices of a sphere, at most: all that patch_offsets.comp may choose.
float widest_spacing(vec3 centre, float radius) {
    float pixels = constants.pixels;
    if (constants.perspective != 0.0)
        pixels /= view_distance(centre) + radius + farthest_reach();
    return constants.spacing * exp2(float(PATCH_WIDEST)) / pixels;
}

struct patch_coordinates {
    vec2 corners[3];
    vec3 measure; // that leads to the coarsest level
};

patch_coordinates coordinates_of_patch(base_patch parts) {
    patch_coordinates result;
    result.measure = vec3(1e30, 1e30, 0.0);
    [[dont_unroll]]
    for (int i = 0; i < 3; ++i) {
        chart_place place = place_in_triangle(
            parts.triangle, vec3(parts.corners[i]) / float(1 << constants.depth));
        result.corners[i] = place.coordinates;
        result.measure.xy = min(result.measure.xy, place.measure.xy);
        result.measure.z = max(result.measure.z, place.measure.z);
    }
    return result;
}

height_bounds bounds_of_patch(patch_coordinates places, float spacing) {
    vec2 low = min(min(places.corners[0], places.corners[1]), places.corners[2]);
    vec2 high = max(max(places.corners[0], places.corners[1]), places.corners[2]);
    float level = spacing_level(places.measure, spacing);
    vec2 margin = REACH_OF_MEANS * exp2(level) / vec2(constants.width, constants.height);
    return bounds_over(low - margin, high + margin);
}

// ---------------------------------------------------------------------------------------------
// Spheres

struct sphere {
    vec3 centre;
    float radius;
};

sphere sphere_around(vec3 corners[3]) {
    vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    return sphere(centre, max(max(length(corners[0] - centre), length(corners[1] - centre)),
                              length(corners[2] - centre)));
}

vec3 world_vector(vec3 v) {
    return vec3(dot(constants.rows[0].xyz, v), dot(constants.rows[1].xyz, v),
                dot(constants.rows[2].xyz, v));
}

// What height 1 displaces the corners of a patch by.
struct patch_displacement {
    vec3 mean;
    float spread; // how far others are from it, at most
};

patch_displacement displacement_of(base_site sites[3]) {
    vec3 offsets[3];
    [[dont_unroll]]
    for (int i = 0; i < 3; ++i)
        offsets[i] = world_vector(constants.relief * site_direction(sites[i]));
    vec3 mean = (offsets[0] + offsets[1] + offsets[2]) / 3.0;
    float spread = max(max(length(offsets[0] - mean), length(offsets[1] - mean)),
                       length(offsets[2] - mean));
    return patch_displacement(mean, 2.0 * spread); // directions between are made unit again
}

sphere displaced_sphere(sphere base, patch_displacement offset, height_bounds heights) {
    float middle = 0.5 * (heights.least + heights.greatest);
    float half_range = 0.5 * (heights.greatest - heights.least);
    return sphere(base.centre + middle * offset.mean,
                  base.radius + half_range * length(offset.mean) +
                      heights.greatest * offset.spread);
}

// ---------------------------------------------------------------------------------------------
// Backs

// How steep triangles of a relief may be, over the slopes that heights have from texel to texel.
const float STEEPER = 2.0;

// The sine of the angle by which displaced triangles lean at most; 1: any.
float steepest_lean(patch_coordinates places, vec3 corners[3], vec3 normal,
                    patch_displacement offset, height_bounds heights) {
    vec3 first = corners[1] - corners[0], second = corners[2] - corners[0];
    vec2 du = places.corners[1] - places.corners[0], dv = places.corners[2] - places.corners[0];
    float square = dot(normal, normal);
    vec3 a = cross(second, normal) / square, b = cross(normal, first) / square;
    vec2 per_metre = vec2(length(du.x * a + dv.x * b), length(du.y * a + dv.y * b)) *
                     vec2(constants.width, constants.height);
    float slope = STEEPER * length(offset.mean) * dot(heights.change, per_metre);
    // Directions that differ between corners stretch triangles, and lean over them.
    float longest = max(max(length(first), length(second)), length(second - first));
    float stretched = heights.greatest * offset.spread * longest / sqrt(square);
    float aslant = length(cross(normalize(normal), normalize(offset.mean)));
    float rise = slope + stretched, run = 1.0 - stretched - slope * aslant;
    return run > 0.25 ? rise / length(vec2(rise, run)) : 1.0;
}

float presence_of_front(patch_coordinates places, vec3 corners[3], sphere whole,
                        patch_displacement offset, height_bounds heights) {
    vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(dot(normal, normal) > 1e-30) || !(dot(offset.mean, offset.mean) > 1e-30))
        return 1.0;
    float lean = steepest_lean(places, corners, normal, offset, heights);
    vec3 towards = constants.eye.xyz - constants.eye.w * whole.centre;
    float radius = constants.eye.w * whole.radius;
    float height = constants.facing * dot(towards, normalize(normal));
    return presence_at(height + radius + lean * (length(towards) + radius), whole.radius);
}

// ---------------------------------------------------------------------------------------------

// A function of the edge alone, as both of its patches need the same.
float presence_of_edge(base_site middle, float size) {
    return presence_in_picture(world_position(site_position(middle)),
                               0.5 * size + bounds_of_map().greatest * farthest_reach());
}

// 1: it is drawn.
float presence_of_patch(base_patch parts, base_site sites[3], vec3 corners[3]) {
    sphere base = sphere_around(corners);
    patch_displacement offset = displacement_of(sites);
    patch_coordinates places = coordinates_of_patch(parts);
    bool seam = is_at_seam(parts.triangle);
    height_bounds heights =
        seam ? bounds_of_map()
             : bounds_of_patch(places, widest_spacing(base.centre, base.radius));
    sphere whole = displaced_sphere(base, offset, heights);
    float presence = presence_in_picture(whole.centre, whole.radius);
    if (presence < 1.0 && has_shadow_in_picture(whole.centre, whole.radius))
        presence = 1.0;
    bool may_show_back_alone = constants.facing != 0.0 && constants.caster_count == 0u && !seam;
    if (presence > 0.0 && may_show_back_alone)
        presence *= presence_of_front(places, corners, whole, offset, heights);
    return presence;
}

#endif
