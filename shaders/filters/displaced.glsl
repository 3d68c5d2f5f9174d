// The diffuse light of a material's relief, with its shadows and the light between its facets, from
// a map of transfer (interface/displacement/relief.h): radiance is a form of two directions, whose
// coefficients are means over facets and may be averaged like colours. After Wu, Zhao, Yan,
// Ramamoorthi, 2019, Accurate Appearance Preserving Prefiltering for Rendering Displacement-Mapped
// Surfaces, whose scaling functions it replaces.
//
// Microfacets are those of the relief's facets, whose normals are kept in bins; the maps' normals
// count only for half-vector lobes and for materials without a relief, which are shaded as by
// `toksvig`.

#include "shading/averaged_maps.glsl"
#include "interface/displacement/relief.h"
#include "lib/displacement/transfer_basis.glsl"
#include "lib/displacement/facet_bins.glsl"
#include "filters/displaced/relief_surface.glsl"
#include "lib/light/cube_texel.glsl"

const bool BIN_COLOUR = false;
const bool BIN_WIDTHS = false;

#include "filters/moments/plane_bin.glsl"

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;

layout(LOBE_DESCRIPTOR(33)) uniform sampler2DArray transfer_map;
layout(LOBE_DESCRIPTOR(34), std430) readonly buffer closure_block {
    transfer_closure_constants closure;
};
layout(LOBE_DESCRIPTOR(35)) uniform sampler2DArray facet_map;

// Light towards the viewer, for each function of the light's direction: a white relief's at once,
// and what it gets from other facets as well.
struct transfer_to_viewer {
    float direct[9];
    float indirect[9];
    float area[9]; // what is seen of it, by the viewer's direction
    float visible; // the area that the viewer sees, over the map's mean of it
};

// What a pixel's lights share.
struct relief_footprint {
    vec3 viewer;
    transfer_to_viewer transfer;
    float seen;         // of the facets' area that faces the viewer
    light_sum lights[4];
    float shone_on[4];  // of the facets' area that faces the light
};
relief_footprint drawn;

// Quads lie between the centres of texels, half a texel further than these.
map_area transfer_area(surface_point surface) {
    vec2 size = 2.0 * vec2(textureSize(transfer_map, 0).xy);
    map_area area = area_of(MAP_HEIGHT, size, surface);
    area.centre -= 0.5 / size;
    return area;
}

const uint DIRECT_ENTRIES = ORDER * (ORDER + 1u) / 2u;
const uint VISIBLE_ENTRIES = DIRECT_ENTRIES + TRANSFER_INDIRECT_COUNT + 1u;

// Adds four entries, of symmetric matrices or of the visible area, times the viewer's functions.
void add_entries(inout transfer_to_viewer transfer, float outgoing[9], vec4 entries, uint layer,
                 inout uint row, inout uint column) {
    for (uint i = 0u; i < 4u; ++i) {
        uint place = 4u * layer + i;
        if (place == DIRECT_ENTRIES)
            row = column = 0u;
        if (place < DIRECT_ENTRIES) {
            transfer.direct[row] += entries[i] * outgoing[column];
            if (row != column)
                transfer.direct[column] += entries[i] * outgoing[row];
        } else if (place < DIRECT_ENTRIES + TRANSFER_INDIRECT_COUNT) {
            transfer.indirect[row] += entries[i] * outgoing[column];
            if (row != column)
                transfer.indirect[column] += entries[i] * outgoing[row];
        } else if (place >= VISIBLE_ENTRIES && place < VISIBLE_ENTRIES + ORDER) {
            transfer.area[place - VISIBLE_ENTRIES] = entries[i];
        }
        if (++column > row) {
            column = 0u;
            ++row;
        }
    }
}

// Of the closure: (d u^T + u d^T) / pi - u u^T (1^T d) / pi^2, with d what lacks, u the cosine.
void add_closure(inout transfer_to_viewer transfer, float outgoing[9]) {
    float lost = 0.0, towards = 0.0;
    float cosine = TRANSFER_COSINE * outgoing[0];
    for (uint k = 0u; k < ORDER; ++k) {
        float lacking = closure.lacking[k / 4u][k % 4u];
        lost += lacking * TRANSFER_INTEGRAL[k];
        towards += lacking * outgoing[k];
        transfer.indirect[k] += INVERSE_PI * lacking * cosine;
    }
    transfer.indirect[0] +=
        TRANSFER_COSINE * INVERSE_PI * (towards - INVERSE_PI * lost * cosine);
}

// The area of the footprint that is seen from where the functions are these, over the map's mean.
float visible_area(transfer_to_viewer transfer, float functions[9]) {
    float sum = 0.0, mean = 0.0;
    for (uint k = 0u; k < ORDER; ++k) {
        sum += transfer.area[k] * functions[k];
        mean += closure.visible[k / 4u][k % 4u] * functions[k];
    }
    return max(sum / max(mean, 1e-6), LEAST_VISIBLE);
}

transfer_to_viewer fetch_transfer(surface_point surface, vec3 viewer) {
    transfer_to_viewer transfer;
    float outgoing[9];
    transfer_functions(viewer, outgoing);
    for (uint k = 0u; k < 9u; ++k)
        transfer.direct[k] = transfer.indirect[k] = 0.0;
    for (uint k = 0u; k < 9u; ++k)
        transfer.area[k] = 0.0;
    map_area area = transfer_area(surface);
    uint row = 0u, column = 0u;
    for (uint layer = 0u; 4u * layer < VISIBLE_ENTRIES + ORDER; ++layer)
        add_entries(transfer, outgoing, filtered_layer(transfer_map, area, layer), layer, row,
                    column);
    add_closure(transfer, outgoing);
    transfer.visible = visible_area(transfer, outgoing);
    return transfer;
}

// Of light between facets, by albedo: sums of powers, each less than the one before by the same
// factor.
vec3 indirect_share(vec3 albedo) {
    return albedo * albedo * (1.0 - closure.persistence) / (1.0 - albedo * closure.persistence);
}

// Radiance of diffuse facets, for light with these coefficients of the functions. `mirrored`: the
// part of light that facets mirror at right angles. What of it meets other facets is taken to go on
// as if it were diffuse.
vec3 diffuse_radiance(vec3 albedo, vec3 mirrored, float light[9]) {
    transfer_to_viewer transfer = drawn.transfer;
    float direct = 0.0, indirect = 0.0;
    for (uint k = 0u; k < 9u; ++k) {
        direct += transfer.direct[k] * light[k];
        indirect += transfer.indirect[k] * light[k];
    }
    albedo = clamp(albedo, 0.0, 1.0);
    vec3 share = indirect_share(albedo) + indirect_share(mirrored);
    return max(albedo * direct + share * indirect, 0.0) / (drawn.viewer.z * transfer.visible);
}

vec3 mirrored_part(base_material base) {
    return MODEL == MODEL_MICROFACET ? clamp(base.specular, 0.0, 1.0) : vec3(0.0);
}

// ---------------------------------------------------------------------------------------------
// Microfacets of the facets

bool has_facets() {
    return RELIEF && MODEL == MODEL_MICROFACET;
}

plane_bin facet_bin(surface_point surface, map_area area, uint index, float width) {
    vec4 place = filtered_layer(facet_map, area, 2u * index);
    vec4 spread = filtered_layer(facet_map, area, 2u * index + 1u);
    float scale = 1.0 / max(place.x, 1e-6);
    vec2 mean = place.yz * scale;
    plane_bin bin;
    bin.mass = place.x;
    bin.mean = facet_bin_centre(index, closure.radius) + mean;
    bin.axis = direction_from_plane(bin.mean);
    bin.variance = bin.mean_variance = plane_variance(distribution_kind(), width);
    bin.sharpness = inversesqrt(bin.variance);
    bin.places = covariance_of(mean, spread.xyz * scale) + surface.curvature;
    bin.spread = 0.5 * (bin.places.x + bin.places.y);
    vec3 base = bin.variance * plane_distortion(bin.mean);
    bin.covariance = bin.places + base;
    // The lobes' own mass, microfacets' area.
    bin.mass *= plane_mass(MODEL, distribution_kind(), width);
    make_terms(bin, bin.places, base, 0.0);
    keep_shape(bin, 0.0);
    return bin;
}

// Facets without their microfacets.
struct facet_areas {
    normal_spread normals[FACET_BINS];
    float sizes[FACET_BINS]; // over that of the carrier
};

void take_area(inout facet_areas areas, uint index, plane_bin bin, float width) {
    areas.normals[index] =
        normal_spread_of(bin.mean, bin.places + second_moments_of(bin.mean));
    areas.sizes[index] = bin.mass / plane_mass(MODEL, distribution_kind(), width);
}

// What faces a direction, hidden or not, as it appears from there.
float facing_area(facet_areas areas, vec3 direction) {
    float sum = 0.0;
    for (uint k = 0u; k < FACET_BINS; ++k)
        if (areas.sizes[k] > 0.0)
            sum += areas.sizes[k] * mean_facing_cosine(areas.normals[k], direction);
    return sum;
}

// The part of the area that faces a direction that is also seen from there: the one by the facets'
// normals alone, the other by their horizons.
float seen_part(float facing, vec3 direction) {
    float functions[9];
    transfer_functions(direction, functions);
    float seen = direction.z * visible_area(drawn.transfer, functions);
    return clamp(seen / max(facing, 1e-6), 0.0, 1.0);
}

// What both directions see, if heights decide: Smith's masking with correlated heights, 1 / (1 +
// Lambda + Lambda'), written with 1 / (1 + Lambda) of both.
float seen_by_both(float first, float second) {
    return first * second / max(first + second - first * second, 1e-6);
}

void gather_relief(appearance fetched, surface_point surface) {
    drawn.viewer = viewer_of(surface);
    drawn.transfer = fetch_transfer(surface, drawn.viewer);
}

void gather_facets(appearance fetched, surface_point surface, vec3 incoming[4]) {
    map_area area = transfer_area(surface);
    facet_areas areas;
    for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i)
        drawn.lights[i] =
            light_sum(0.0, vec2(0.0), vec3(0.0), 0.0, vec3(0.0), vec3(0.0));
    for (uint k = 0u; k < FACET_BINS; ++k) {
        plane_bin bin = facet_bin(surface, area, k, fetched.base.width);
        take_area(areas, k, bin, fetched.base.width);
        if (areas.sizes[k] <= 1e-4)
            continue;
        for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i) {
            vec3 halfway = half_vector(incoming[i], surface.outgoing);
            add_bin_to_light(drawn.lights[i], bin, halfway, plane_from_direction(halfway));
        }
    }
    drawn.seen = seen_part(facing_area(areas, drawn.viewer), drawn.viewer);
    for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i)
        drawn.shone_on[i] = seen_part(facing_area(areas, incoming[i]), incoming[i]);
}

// Cook, Torrance, 1982, of all facets: their areas, seen and lit by parts, over the area that the
// viewer sees.
vec3 mirrored_by_facets(base_material base, vec3 fresnel, vec3 outgoing, vec3 incoming,
                        uint light) {
    light_sum sum = drawn.lights[light];
    float scale = 1.0 / max(sum.distribution, 1e-20);
    facing_cosines cosines = facing_cosines_of(
        normal_spread_of(scale * sum.place, scale * sum.second_moments), incoming, outgoing);
    float visible =
        masking_shadowing(DISTRIBUTION, cosines.incoming, cosines.outgoing, base.width) *
        seen_by_both(drawn.seen, drawn.shone_on[light]);
    return fresnel * scattering_scale(base.specular, cosines.outgoing, base.width) *
           (cosines.share * sum.distribution * visible /
            (4.0 * drawn.viewer.z * drawn.transfer.visible));
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (has_diffuse())
        gather_relief(fetched, surface);
    if (has_facets())
        gather_facets(fetched, surface, incoming);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    vec3 albedo = base.diffuse;
    base.diffuse = vec3(0.0);
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 lobes, fresnel = vec3(0.0);
    if (has_facets()) {
        fresnel = fresnel_schlick(base.specular, vec3(1.0),
                                  dot(incoming, half_vector(incoming, surface.outgoing)));
        lobes = mirrored_by_facets(fetched.base, fresnel, surface.outgoing, incoming, light);
    } else {
        lobes = evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    }
    float functions[9];
    transfer_functions(incoming, functions);
    return lobes + diffuse_radiance(albedo * (1.0 - fresnel), mirrored_part(base), functions);
}

#ifdef ENVIRONMENT
// The environment's coefficients, of each channel: sums over the texels of a coarse level. What
// these sums are off for light that is the same everywhere is added with the mean radiance.
const int LIGHT_WIDTH = 8;

void light_of_environment(surface_point surface, out float light[3][9]) {
    mat3 tangent_from_environment = tangent_from_environment_of(surface);
    int level = level_of_faces(LIGHT_WIDTH);
    int size = textureSize(environment_faces, level).x;
    float sums[9];
    for (int k = 0; k < 9; ++k)
        light[0][k] = light[1][k] = light[2][k] = sums[k] = 0.0;
    vec4 mean = vec4(0.0); // radiance times cosine, cosine
    for (int i = 0; i < 6 * size * size; ++i) {
        int face = i / (size * size);
        ivec2 texel = ivec2(i % size, (i / size) % size);
        float functions[9];
        transfer_functions(tangent_from_environment * cube_texel_direction(face, texel, size),
                           functions);
        float solid_angle = cube_texel_solid_angle(texel, size);
        vec3 irradiance = texelFetch(environment_faces, ivec3(texel, face), level).rgb *
                          (environment.intensity * solid_angle);
        mean += vec4(irradiance, solid_angle) * functions[0];
        for (int k = 0; k < 9; ++k) {
            sums[k] += solid_angle * functions[k];
            light[0][k] += irradiance.r * functions[k];
            light[1][k] += irradiance.g * functions[k];
            light[2][k] += irradiance.b * functions[k];
        }
    }
    mean /= max(mean.w, 1e-6);
    for (int k = 0; k < 9; ++k)
        for (int channel = 0; channel < 3; ++channel)
            light[channel][k] += mean[channel] * (TRANSFER_INTEGRAL[k] - sums[k]);
}

// Each bin by the area of it that faces the viewer, masked, and shadowed in the direction that its
// mean facet mirrors.
vec3 reflect_facets_of_relief(appearance fetched, surface_point surface) {
    map_area area = transfer_area(surface);
    float width = fetched.base.width;
    facet_areas areas;
    for (uint k = 0u; k < FACET_BINS; ++k)
        take_area(areas, k, facet_bin(surface, area, k, width), width);
    float seen = seen_part(facing_area(areas, drawn.viewer), drawn.viewer);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        float share;
        vec3 normal = facing_normals(areas.normals[k], drawn.viewer, share).mean;
        if (areas.sizes[k] * share <= 1e-4)
            continue;
        vec3 incoming = reflect(-drawn.viewer, normalize(normal));
        float lit = seen_part(facing_area(areas, incoming), incoming);
        float facing = mean_facing_cosine(areas.normals[k], drawn.viewer) / max(share, 1e-3);
        sum += (areas.sizes[k] * facing * seen_by_both(seen, lit)) *
               reflect_bin(surface, facet_bin(surface, area, k, width), fetched.base.specular);
    }
    return sum / (drawn.viewer.z * drawn.transfer.visible);
}

vec3 reflect_environment(appearance fetched, surface_point surface) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return reflect_base_material(surface, base, fetched.mean_normal);
    vec3 albedo = let_through(surface, base);
    base.diffuse = vec3(0.0);
    float light[3][9];
    light_of_environment(surface, light);
    gather_relief(fetched, surface);
    vec3 sum = has_facets() ? reflect_facets_of_relief(fetched, surface)
                            : reflect_base_specular(surface, base);
    for (int channel = 0; channel < 3; ++channel)
        sum[channel] += diffuse_radiance(albedo, mirrored_part(base), light[channel])[channel];
    return sum;
}
#endif
