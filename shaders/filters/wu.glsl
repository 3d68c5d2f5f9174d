// The light of a material's relief by a coarse relief, lobes of normals, and factors that stand for
// shadows and light between facets (interface/displacement/wu.h):
//
// Wu, Zhao, Yan, Ramamoorthi, 2019, Accurate Appearance Preserving Prefiltering for Rendering
// Displacement-Mapped Surfaces. Light is summed over the cells of a footprint, and divided by the
// area of them that is seen, rather than followed over the coarse relief.
//
// Microfacets are those of the cells' lobes. Half-vector lobes, and materials without a relief, are
// shaded as by `toksvig`.

#include "filters/wu/cells.glsl"
#include "filters/wu/directions.glsl"
#include "interface/displacement/relief.h"
#include "shading/averaged_maps.glsl"
#include "filters/displaced/relief_frame.glsl"
#include "filters/displaced/relief_surface.glsl"
#include "lib/light/cube_texel.glsl"

const bool BIN_COLOUR = false;
const bool BIN_WIDTHS = false;

#include "filters/displaced/mirrored_light.glsl"

layout(LOBE_DESCRIPTOR(38), std430) readonly buffer ratio_block { vec2 ratios[]; };
layout(LOBE_DESCRIPTOR(39), std430) readonly buffer whole_block {
    vec4 energy;
    float mirrors[];
};

vec2 relief_texels() {
    return vec2(wu.width, wu.height);
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

// The same of what facets mirror.
float scaling_of_mirrors(uint level, table_place incoming, table_place outgoing) {
    uint directions = wu.angular * wu.angular, first = level * mirror_stride();
    float sum = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            sum += incoming.weights[i] * outgoing.weights[j] *
                   mirrors[first + incoming.indices[i] * directions + outgoing.indices[j]];
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

float mirror_scaling_of_cell(uint level_index, uint cell) {
    uint directions = wu.angular * wu.angular;
    uint first = level_index * mirror_stride() + directions * directions;
    patch_range range = patches_of_cell(level_index, cell);
    vec2 sum = vec2(0.0);
    for (int y = range.first.y; y <= range.last.y; ++y)
        for (int x = range.first.x; x <= range.last.x; ++x) {
            uint place = first + 2u * patch_index(ivec2(x, y));
            sum += patch_weight(range, ivec2(x, y)) * vec2(mirrors[place], mirrors[place + 1u]);
        }
    return sum.y > 0.0 ? sum.x / sum.y : 1.0;
}

// ---------------------------------------------------------------------------------------------
// Light

bool has_facets() {
    return RELIEF && MODEL == MODEL_MICROFACET;
}

#ifdef ENVIRONMENT
// Light of an environment is that of the upper half of the texels of a coarse level.
const int LIGHT_WIDTH = 4;
const int MOST_LIGHTS = 6 * LIGHT_WIDTH * LIGHT_WIDTH;
#else
const int MOST_LIGHTS = 4;
#endif

// Below a table's lowest directions S says nothing, while the part of the relief that is seen goes
// on to fall with the height: what is seen from there is what the table's lowest direction sees, by
// the quotient of both heights.
vec3 raised_into_table(vec3 direction) {
    float height = lowest_height(wu.angular);
    if (direction.z >= height)
        return direction;
    float level = max(length(direction.xy), 1e-6);
    return vec3(direction.xy * (sqrt(1.0 - height * height) / level), height);
}

float part_below_table(vec3 direction) {
    return clamp(direction.z / lowest_height(wu.angular), 0.0, 1.0);
}

// What a pixel's lights share. Of each light, towards the viewer, over the base's area: of white
// facets at once, and by way of others, before the powers of the albedo.
struct relief_footprint {
    vec3 viewer;        // in the relief's frame, see raised_into_table
    vec3 outgoing;      // the same in the tangent frame
    float visible;      // the area that the viewer sees
    vec3 share;         // see indirect_share
    int lights;         // how many
    vec3 towards[MOST_LIGHTS]; // see raised_into_table
    float parts[MOST_LIGHTS];  // see part_below_table
    vec3 direct[MOST_LIGHTS];
    vec3 indirect[MOST_LIGHTS];
    vec3 incoming[4];          // of the first lights, in the tangent frame
    light_sum mirrored[4];     // of these
};
relief_footprint drawn;

void place_light(int light, vec3 incoming) {
    vec3 towards = relief_from_tangent(incoming);
    drawn.towards[light] = raised_into_table(towards);
    drawn.parts[light] = part_below_table(towards);
}

// Normals of a cell's lobes, and with them their weights times their cosines to the viewer.
vec4 facing[8u * WU_LOBES];
// Weights of a normal of each lobe.
float weights[WU_LOBES];

// What normals get of a light and show to the viewer, and what they get.
vec2 light_of_facing(vec3 light) {
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < WU_LOBES; ++i) {
        float got = 0.0;
        for (uint k = 0u; k < 8u; ++k) {
            vec4 normal = facing[8u * i + k];
            float cosine = max(dot(normal.xyz, light), 0.0);
            sum.x += normal.w * cosine;
            got += cosine;
        }
        sum.y += weights[i] * got;
    }
    return sum;
}

// Returns what they show to the viewer, of light that they get from everywhere.
float find_facing(uint cell) {
    float sum = 0.0;
    for (uint i = 0u; i < WU_LOBES; ++i) {
        vec4 lobe = cells[cell].lobes[i];
        float weight = length(lobe.xyz);
        weights[i] = weight / (8.0 * PI);
        lobe_normals normals = normals_of_weighted(lobe, weight);
        for (int k = 0; k < 8; ++k) {
            float shown = max(dot(normals.normals[k], drawn.viewer), 0.0);
            sum += weight / 8.0 * shown;
            facing[8u * i + k] =
                vec4(normals.normals[k],
                     weights[i] * (is_printed(WU_PRINTED_LOBES) ? 1.0 : shown));
        }
    }
    return sum;
}

// A lobe of normals with microfacets of this width, in the tangent frame.
plane_bin bin_of_lobe(vec4 lobe, vec3 curvature, float width) {
    float weight = length(lobe.xyz);
    plane_bin bin;
    bin.axis = weight > 0.0 ? tangent_from_relief(lobe.xyz / weight) : vec3(0.0, 0.0, 1.0);
    bin.mean = plane_from_direction(bin.axis);
    bin.variance = bin.mean_variance = plane_variance(distribution_kind(), width);
    bin.sharpness = inversesqrt(bin.variance);
    // The mean cosine to the axis is coth k - 1 / k.
    float wide = 1.0 - 1.0 / tanh(min(lobe.w, 40.0)) + 1.0 / lobe.w;
    vec3 distortion = plane_distortion(bin.mean);
    bin.places = wide * distortion + curvature;
    bin.spread = 0.5 * (bin.places.x + bin.places.y);
    vec3 base = bin.variance * distortion;
    bin.covariance = bin.places + base;
    bin.mass = weight * plane_mass(MODEL, distribution_kind(), width);
    make_terms(bin, bin.places, base, vec2(bin.variance), 0.0);
    keep_shape(bin, vec2(bin.variance));
    return bin;
}

// How much less than S says is seen of facets that mirror, from a direction below the table: of
// steep ones in proportion to the height, of level ones no less, as these turn away by themselves.
float mirrors_below_table(vec3 direction) {
    float part = part_below_table(direction);
    if (part >= 1.0)
        return 1.0;
    return min(part * light_of_facing(raised_into_table(direction)).y /
                   max(light_of_facing(direction).y, 1e-9),
               1.0);
}

// Wu et al., 2019, Eq. 18: T S f'_low, of microfacets.
// `scaling`: of mirrors, for each light.
void add_mirrored_light(uint level, uint cell, float weight, seen_facets seen, float scaling[4],
                        surface_point surface, float width) {
    vec3 viewer = relief_from_tangent(drawn.outgoing);
    float factor = weight * mirror_scaling_of_cell(level, cell) * mirrors_below_table(viewer) /
                   max(part_below_table(viewer), 1e-6);
    float parts[4];
    for (uint k = 0u; k < LIGHTS_AT_ONCE; ++k)
        parts[k] = factor * scaling[k] *
                   mirrors_below_table(relief_from_tangent(drawn.incoming[k])) *
                   seen_by_both(seen, facets_seen(cell, drawn.towards[k]));
    for (uint i = 0u; i < WU_LOBES; ++i) {
        plane_bin bin = bin_of_lobe(cells[cell].lobes[i], surface.curvature, width);
        for (uint k = 0u; k < LIGHTS_AT_ONCE; ++k) {
            vec3 incoming = drawn.incoming[k];
            if (bin.mass > 0.0 && parts[k] > 0.0)
                add_seen_bin(drawn.mirrored[k], bin, half_vector(incoming, drawn.outgoing),
                             drawn.outgoing, incoming, parts[k]);
        }
    }
}

void add_level(uint level, vec2 centre, float share, surface_point surface, float width) {
    covered_cells covered = cells_around(level, centre);
    table_place outgoing = place_in_table(drawn.viewer);
    const bool mirrors = has_facets() && width > 0.0;
    vec2 scaling[MOST_LIGHTS];
    float mirror_scaling[4] = float[4](0.0, 0.0, 0.0, 0.0);
    for (int k = 0; k < drawn.lights; ++k) {
        table_place incoming = place_in_table(drawn.towards[k]);
        scaling[k] = scaling_of_directions(level, incoming, outgoing);
        if (mirrors && k < 4)
            mirror_scaling[k] = scaling_of_mirrors(level, incoming, outgoing);
    }
    for (int i = 0; i < 4; ++i) {
        uint cell = covered.cells[i];
        float weight = share * covered.weights[i];
        if (weight <= 0.0)
            continue;
        seen_facets seen = facets_seen(cell, drawn.viewer);
        float area = 0.5 * (seen.areas.x + seen.areas.y);
        drawn.visible += weight * area;
        if (area <= 0.0)
            continue;
        float shown = part_seen(seen) * find_facing(cell);
        vec3 factor = weight * scaling_of_cell(cell, drawn.share);
        for (int k = 0; k < drawn.lights; ++k) {
            seen_facets lit = facets_seen(cell, drawn.towards[k]);
            float both = is_printed(WU_PRINTED_LOBES)
                             ? seen_by_both_printed(cell, seen, lit, drawn.towards[k].z)
                             : seen_by_both(seen, lit);
            vec2 light = vec2(both, shown * part_seen(lit)) * light_of_facing(drawn.towards[k]) *
                         scaling[k];
            drawn.direct[k] += light.x * factor;
            drawn.indirect[k] += light.y * factor;
        }
        if (mirrors)
            add_mirrored_light(level, cell, weight, seen, mirror_scaling, surface, width);
    }
}

// Sums over the cells of the footprint, for the lights in `drawn`. `width`: of microfacets; 0: what
// they mirror is not asked for.
void gather_cells(appearance fetched, surface_point surface, float width) {
    drawn.outgoing = viewer_of(surface);
    drawn.viewer = raised_into_table(relief_from_tangent(drawn.outgoing));
    drawn.share = indirect_share(clamp(fetched.base.diffuse, 0.0, 1.0));
    drawn.visible = 0.0;
    for (int k = 0; k < drawn.lights; ++k)
        drawn.direct[k] = drawn.indirect[k] = vec3(0.0);
    for (int k = 0; k < 4; ++k)
        drawn.mirrored[k] = no_light();
    map_area area = area_of(MAP_HEIGHT, vec2(wu.width, wu.height), surface);
    float share;
    uint level = coarser_level(area.level, share);
    float part = share / float(probes_of(area)), rest = (1.0 - share) / float(probes_of(area));
    for (uint i = 0u; i < probes_of(area); ++i) {
        vec2 centre = probe_position(area, i);
        add_level(level, centre, part, surface, width);
        if (rest > 0.0)
            add_level(level - 1u, centre, rest, surface, width);
    }
    float lacking = max(LEAST_VISIBLE * drawn.viewer.z - drawn.visible, 0.0);
    drawn.visible += lacking;
    for (int k = 0; k < drawn.lights; ++k) {
        drawn.direct[k] += lacking * INVERSE_PI * drawn.towards[k].z;
        drawn.direct[k] *= drawn.parts[k];
        drawn.indirect[k] *= drawn.parts[k];
    }
}

// Radiance of diffuse facets for irradiance 1 of a light. `mirrored`: the part of light that facets
// mirror at right angles. What of it meets other facets is taken to go on as if it were diffuse.
vec3 diffuse_radiance(vec3 albedo, vec3 mirrored, int light) {
    vec3 share = albedo * indirect_share(albedo) + mirrored * indirect_share(mirrored);
    return (albedo * drawn.direct[light] + share * drawn.indirect[light]) / drawn.visible;
}

vec3 mirrored_part(base_material base) {
    return MODEL == MODEL_MICROFACET ? clamp(base.specular, 0.0, 1.0) : vec3(0.0);
}

appearance fetch_appearance(surface_point surface) {
    lay_relief_on(surface);
    return fetch_averaged_appearance(surface, surface);
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (!has_diffuse())
        return;
    drawn.lights = int(LIGHTS_AT_ONCE);
    for (int k = 0; k < drawn.lights; ++k) {
        drawn.incoming[k] = incoming[k];
        place_light(k, incoming[k]);
    }
    gather_cells(fetched, surface, has_facets() ? fetched.base.width : 0.0);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    vec3 albedo = clamp(base.diffuse, 0.0, 1.0);
    base.diffuse = vec3(0.0);
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 lobes, fresnel = vec3(0.0);
    if (has_facets()) {
        fresnel = fresnel_schlick(base.specular, vec3(1.0),
                                  dot(incoming, half_vector(incoming, drawn.outgoing)));
        lobes = mirrored_light(fetched.base, drawn.mirrored[light], fresnel) / drawn.visible;
    } else {
        lobes = evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    }
    return lobes + diffuse_radiance(albedo * (1.0 - fresnel), mirrored_part(base), int(light));
}

#ifdef ENVIRONMENT
// The part of the light from everywhere that the chosen texels' cosines do not sum to is shared out
// among them. Returns the irradiance of each, perpendicular to its direction.
vec3 irradiances[MOST_LIGHTS];

void find_lights(surface_point surface) {
    mat3 tangent_from_environment = tangent_from_environment_of(surface);
    int level = level_of_faces(LIGHT_WIDTH);
    int size = min(textureSize(environment_faces, level).x, LIGHT_WIDTH);
    float cosines = 0.0;
    drawn.lights = 0;
    for (int i = 0; i < 6 * size * size; ++i) {
        int face = i / (size * size);
        ivec2 texel = ivec2(i % size, (i / size) % size);
        vec3 incoming = tangent_from_environment * cube_texel_direction(face, texel, size);
        if (incoming.z <= 0.0)
            continue;
        float solid_angle = cube_texel_solid_angle(texel, size);
        place_light(drawn.lights, incoming);
        irradiances[drawn.lights] = texelFetch(environment_faces, ivec3(texel, face), level).rgb *
                                    (environment.intensity * solid_angle);
        cosines += solid_angle * incoming.z;
        ++drawn.lights;
    }
    for (int k = 0; k < drawn.lights; ++k)
        irradiances[k] *= PI / cosines;
}

// Each lobe by the area of it that faces the viewer, and where both the viewer and the direction
// that its mean facet mirrors see the coarse relief.
vec3 mirrored_by_cell(uint level, uint cell, surface_point surface, base_material base) {
    seen_facets seen = facets_seen(cell, drawn.viewer);
    table_place outgoing = place_in_table(drawn.viewer);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < WU_LOBES; ++i) {
        plane_bin bin = bin_of_lobe(cells[cell].lobes[i], surface.curvature, base.width);
        normal_spread normals =
            normal_spread_of(bin.mean, bin.places + second_moments_of(bin.mean));
        float share;
        vec3 normal = facing_normals(normals, drawn.outgoing, share).mean;
        float area = length(cells[cell].lobes[i].xyz);
        if (area * share <= 1e-4)
            continue;
        vec3 incoming = relief_from_tangent(reflect(-drawn.outgoing, normalize(normal)));
        float both = seen_by_both(seen, facets_seen(cell, incoming));
        if (both <= 0.0 || incoming.z <= 0.0)
            continue;
        float faces = mean_facing_cosine(normals, drawn.outgoing) / max(share, 1e-3);
        sum += (area * faces * both *
                scaling_of_mirrors(level, place_in_table(incoming), outgoing)) *
               reflect_bin(surface, bin, base.specular, VIEW_OF_BIN);
    }
    return mirror_scaling_of_cell(level, cell) * sum;
}

vec3 mirrored_by_cells(surface_point surface, base_material base) {
    map_area area = area_of(MAP_HEIGHT, vec2(wu.width, wu.height), surface);
    float share;
    uint level = coarser_level(area.level, share);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 2u * probes_of(area); ++i) {
        float part = i % 2u == 0u ? share : 1.0 - share;
        if (part <= 0.0)
            continue;
        covered_cells covered = cells_around(level - i % 2u, probe_position(area, i / 2u));
        for (int k = 0; k < 4; ++k)
            if (covered.weights[k] > 0.0)
                sum += part * covered.weights[k] *
                       mirrored_by_cell(covered.level, covered.cells[k], surface, base);
    }
    return sum / (float(probes_of(area)) * drawn.visible);
}

vec3 reflect_environment(appearance fetched, surface_point surface) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return reflect_base_material(surface, base, fetched.mean_normal);
    vec3 albedo = clamp(let_through(surface, base), 0.0, 1.0);
    base.diffuse = vec3(0.0);
    find_lights(surface);
    gather_cells(fetched, surface, 0.0);
    vec3 sum = has_facets() ? mirrored_by_cells(surface, fetched.base)
                            : reflect_base_specular(surface, base);
    for (int k = 0; k < drawn.lights; ++k)
        sum += irradiances[k] * diffuse_radiance(albedo, mirrored_part(base), k);
    return sum;
}
#endif
