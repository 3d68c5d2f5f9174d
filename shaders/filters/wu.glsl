// The diffuse light of a material's relief by a coarse relief, lobes of normals, and factors that
// stand for shadows and light between facets (interface/displacement/wu.h):
//
// Wu, Zhao, Yan, Ramamoorthi, 2019, Accurate Appearance Preserving Prefiltering for Rendering
// Displacement-Mapped Surfaces. Light is summed over the cells of a footprint, and divided by the
// area of them that is seen, rather than followed over the coarse relief.
//
// Lobes, and materials without a relief, are shaded as by `toksvig`.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "interface/displacement/relief.h"
#include "shading/averaged_maps.glsl"
#include "filters/displaced/relief_surface.glsl"
#include "lib/light/cube_texel.glsl"

layout(LOBE_DESCRIPTOR(38), std430) readonly buffer ratio_block { vec2 ratios[]; };
layout(LOBE_DESCRIPTOR(39), std430) readonly buffer energy_block { vec4 energy; };

// The relief's y runs against the tangent frame's.
vec3 relief_from_tangent(vec3 direction) {
    return vec3(direction.x, -direction.y, direction.z);
}

// ---------------------------------------------------------------------------------------------
// Which cells a footprint covers

// Four cells of a level, and their weights.
struct covered_cells {
    uint cells[4];
    vec4 weights;
    uint level;
};

covered_cells cells_around(uint level_index, vec2 centre) {
    wu_level level = wu.levels[level_index];
    vec2 size = vec2(level.width, level.height);
    // Quads begin at the centres of texels.
    vec2 place = (centre * vec2(wu.width, wu.height) - 0.5) /
                     vec2(level.spacing_x, level.spacing_y) - 0.5;
    vec2 first = floor(place), between = place - first;
    vec2 low = first - size * floor(first / size), high = first + 1.0;
    high -= size * floor(high / size);
    uvec2 a = min(uvec2(low), uvec2(size) - 1u), b = min(uvec2(high), uvec2(size) - 1u);
    covered_cells result;
    result.cells[0] = level.first_cell + a.y * level.width + a.x;
    result.cells[1] = level.first_cell + a.y * level.width + b.x;
    result.cells[2] = level.first_cell + b.y * level.width + a.x;
    result.cells[3] = level.first_cell + b.y * level.width + b.x;
    result.weights = vec4((1.0 - between.x) * (1.0 - between.y), between.x * (1.0 - between.y),
                          (1.0 - between.x) * between.y, between.x * between.y);
    result.level = level_index;
    return result;
}

// The coarser of the two levels that a footprint is between; the finer one is before it.
uint coarser_level(float octave, out float share) {
    uint level = 0u;
    while (level + 1u < wu.level_count && wu.levels[level].octave < octave)
        ++level;
    share = 1.0;
    if (level > 0u) {
        float finer = wu.levels[level - 1u].octave;
        share = clamp((octave - finer) / max(wu.levels[level].octave - finer, 1e-6), 0.0, 1.0);
    }
    return level;
}

// ---------------------------------------------------------------------------------------------
// S and T

// A direction's four neighbours in the table, and their weights.
struct table_place {
    uint indices[4];
    vec4 weights;
};

table_place place_in_table(vec3 direction) {
    float count = float(wu.angular);
    vec2 place = (0.5 * square_of_direction(direction) + 0.5) * count - 0.5;
    place = clamp(place, 0.0, count - 1.0);
    uvec2 first = uvec2(place), next = min(first + 1u, uvec2(wu.angular - 1u));
    vec2 between = place - vec2(first);
    return table_place(uint[4](first.y * wu.angular + first.x, first.y * wu.angular + next.x,
                               next.y * wu.angular + first.x, next.y * wu.angular + next.x),
                       vec4((1.0 - between.x) * (1.0 - between.y), between.x * (1.0 - between.y),
                            (1.0 - between.x) * between.y, between.x * between.y));
}

vec2 scaling_of_directions(uint level, table_place incoming, table_place outgoing) {
    uint directions = wu.angular * wu.angular;
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            sum += incoming.weights[i] * outgoing.weights[j] *
                   ratios[wu.levels[level].first_pair + incoming.indices[i] * directions +
                          outgoing.indices[j]];
    return sum;
}

// The light by way of other facets, over that of a white relief, by albedo; divided by the albedo.
vec3 indirect_share(vec3 albedo) {
    float persistence = energy.y;
    return albedo * (1.0 - persistence) / (1.0 - albedo * persistence);
}

vec3 scaling_of_cell(uint cell, vec3 share) {
    vec4 above = cells[cell].numerator, below = cells[cell].denominator;
    vec3 divisor = below.x + share * (below.y + share * below.z);
    return (above.x + share * (above.y + share * above.z)) / max(divisor, vec3(1e-20));
}

// ---------------------------------------------------------------------------------------------
// Light

// Towards the viewer: from a light, over the base's area; and the area that is seen.
struct cell_light {
    vec3 light;
    float visible;
};

void add_level(inout cell_light sum, covered_cells covered, float share, vec3 albedo, vec3 incoming,
               vec3 outgoing) {
    vec2 scaling = scaling_of_directions(covered.level, place_in_table(incoming),
                                         place_in_table(outgoing));
    vec3 indirect = indirect_share(albedo);
    for (int i = 0; i < 4; ++i) {
        uint cell = covered.cells[i];
        float weight = share * covered.weights[i];
        vec2 seen = seen_areas(cell, outgoing);
        sum.visible += weight * 0.5 * (seen.x + seen.y);
        float both = seen_by_both(seen, seen_areas(cell, incoming));
        if (both > 0.0)
            sum.light += weight * both * unshadowed_light(cell, incoming, outgoing) * albedo *
                         scaling_of_cell(cell, indirect) * (scaling.x + indirect * scaling.y);
    }
}

// Radiance of diffuse facets for light of irradiance 1 on a plane that faces it.
vec3 diffuse_radiance(surface_point surface, vec3 albedo, vec3 incoming) {
    map_area area = area_of(MAP_HEIGHT, vec2(wu.width, wu.height), surface);
    vec3 outgoing = relief_from_tangent(viewer_of(surface)), light = relief_from_tangent(incoming);
    float share;
    uint level = coarser_level(area.level, share);
    cell_light sum = cell_light(vec3(0.0), 0.0);
    float part = share / float(probes_of(area)), rest = (1.0 - share) / float(probes_of(area));
    for (uint i = 0u; i < probes_of(area); ++i) {
        vec2 centre = probe_position(area, i);
        add_level(sum, cells_around(level, centre), part, albedo, light, outgoing);
        if (rest > 0.0)
            add_level(sum, cells_around(level - 1u, centre), rest, albedo, light, outgoing);
    }
    return sum.light / max(sum.visible, LEAST_VISIBLE * outgoing.z);
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    vec3 albedo = base.diffuse;
    base.diffuse = vec3(0.0);
    vec3 lobes = evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    if (incoming.z <= 0.0)
        return lobes;
    vec3 halfway = half_vector(incoming, surface.outgoing);
    vec3 passed = MODEL == MODEL_MICROFACET
                      ? 1.0 - fresnel_schlick(base.specular, vec3(1.0), dot(incoming, halfway))
                      : vec3(1.0);
    return lobes + diffuse_radiance(surface, clamp(albedo * passed, 0.0, 1.0), incoming);
}

#ifdef ENVIRONMENT
// Light of an environment is summed over the texels of a coarse level.
const int LIGHT_WIDTH = 4;

vec3 reflect_environment(appearance fetched, surface_point surface) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return reflect_base_material(surface, base, fetched.mean_normal);
    vec3 albedo = clamp(let_through(surface, base), 0.0, 1.0);
    base.diffuse = vec3(0.0);
    vec3 sum = reflect_base_specular(surface, base);
    mat3 tangent_from_environment = tangent_from_environment_of(surface);
    int level = level_of_faces(LIGHT_WIDTH);
    int size = textureSize(environment_faces, level).x;
    for (int i = 0; i < 6 * size * size; ++i) {
        int face = i / (size * size);
        ivec2 texel = ivec2(i % size, (i / size) % size);
        vec3 incoming = tangent_from_environment * cube_texel_direction(face, texel, size);
        if (incoming.z <= 0.0)
            continue;
        vec3 irradiance = texelFetch(environment_faces, ivec3(texel, face), level).rgb *
                          (environment.intensity * cube_texel_solid_angle(texel, size));
        sum += irradiance * diffuse_radiance(surface, albedo, incoming);
    }
    return sum;
}
#endif
