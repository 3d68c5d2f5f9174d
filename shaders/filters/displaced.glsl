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
#include "filters/displaced/functions.glsl"
#include "filters/displaced/relief_surface.glsl"
#include "lib/light/cube_texel.glsl"

const bool BIN_COLOUR = false;
const bool BIN_WIDTHS = false;

#include "filters/displaced/mirrored_light.glsl"

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;
layout(constant_id = SPECIALISE_TRANSFER_COLOURED) const bool COLOURED = false;
layout(constant_id = SPECIALISE_TRANSFER_MAGNIFIED) const bool MAGNIFIED = false;

layout(LOBE_DESCRIPTOR(33)) uniform sampler2DArray transfer_map;
layout(LOBE_DESCRIPTOR(34), std430) readonly buffer closure_block {
    transfer_closure_constants closure;
};
layout(LOBE_DESCRIPTOR(35)) uniform sampler2DArray facet_map;

vec4 function_factors(uint place) {
    return closure.basis.functions[place];
}

// A direction, or light, by coefficients: in all polynomials, and in the map's functions.
struct transfer_light {
    float polynomials[16];
    float functions[9]; // as far as they are used
};

void find_functions(inout transfer_light light) {
    for (uint k = 0u; k < ORDER; ++k)
        light.functions[k] = function_of(k, light.polynomials);
}

// 0 below the horizon.
transfer_light light_from(vec3 direction) {
    transfer_light light;
    transfer_polynomials(direction, light.polynomials);
    find_functions(light);
    return light;
}

const uint CHANNELS = COLOURED ? 3u : 1u;

// Light towards the viewer, for each function of the light's direction, of each channel: a white
// relief's (or the coloured one's) at once, and what it gets from other facets as well.
struct transfer_to_viewer {
    float direct[3][9];
    float indirect[3][TRANSFER_INDIRECT];
    float area[9]; // what is seen of it, by the viewer's direction
    float cosine;  // of the viewer's direction
    float lacking; // what a white relief lacks towards the viewer
    vec3 colour;   // the mean diffuse colour, if it varies
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

const uint DIRECT_ENTRIES = TRANSFER_DIRECT_COUNT(ORDER);
const uint INDIRECT_END = DIRECT_ENTRIES + TRANSFER_INDIRECT_COUNT;
const uint VISIBLE_ENTRIES = TRANSFER_ENTRIES(ORDER);

// Adds four entries, of matrices or of the visible area, times the viewer's functions.
void add_entries(inout transfer_to_viewer transfer, transfer_light outgoing, vec4 entries,
                 uint channel, uint layer, inout uint row, inout uint column) {
    for (uint i = 0u; i < 4u; ++i) {
        uint place = 4u * layer + i;
        if (place == DIRECT_ENTRIES)
            row = column = 0u;
        if (place < DIRECT_ENTRIES) {
            transfer.direct[channel][row] += entries[i] * outgoing.functions[column];
            if (row != column)
                transfer.direct[channel][column] += entries[i] * outgoing.functions[row];
        } else if (place < INDIRECT_END) {
            transfer.indirect[channel][row] += entries[i] * outgoing.polynomials[column];
            if (row != column)
                transfer.indirect[channel][column] += entries[i] * outgoing.polynomials[row];
        } else if (place == INDIRECT_END) {
            transfer.colour[channel] = entries[i];
        } else if (channel == 0u && place < VISIBLE_ENTRIES + ORDER) {
            transfer.area[place - VISIBLE_ENTRIES] = entries[i];
        }
        if (++column > row) {
            column = 0u;
            ++row;
        }
    }
}

float product_with_lacking(transfer_light light) {
    float sum = 0.0;
    for (uint k = 0u; k < 16u; ++k)
        sum += closure.lacking[k / 4u][k % 4u] * light.polynomials[k];
    return sum;
}

// The closure: (d u^T + u d^T) / pi - u u^T (1^T d) / pi^2, with d what lacks, u the cosine.
float closing_light(transfer_light light) {
    float cosine = TRANSFER_COSINE * light.polynomials[0];
    return INVERSE_PI * (drawn.transfer.lacking * cosine +
                         drawn.transfer.cosine * (product_with_lacking(light) -
                                                  INVERSE_PI * closure.lost * cosine));
}

// The area of the footprint that is seen from a direction, over the map's mean.
float visible_area(transfer_to_viewer transfer, transfer_light light) {
    float sum = 0.0, mean = 0.0;
    for (uint k = 0u; k < ORDER; ++k) {
        sum += transfer.area[k] * light.functions[k];
        mean += closure.visible[k / 4u][k % 4u] * light.functions[k];
    }
    return max(sum / max(mean, 1e-6), LEAST_VISIBLE);
}

transfer_to_viewer fetch_transfer(surface_point surface, vec3 viewer) {
    transfer_to_viewer transfer;
    transfer_light outgoing = light_from(viewer);
    for (uint k = 0u; k < 9u; ++k)
        transfer.area[k] = 0.0;
    map_area area = transfer_area(surface);
    uint first = 0u;
    for (uint channel = 0u; channel < CHANNELS; ++channel) {
        for (uint k = 0u; k < 9u; ++k)
            transfer.direct[channel][k] = 0.0;
        for (uint k = 0u; k < TRANSFER_INDIRECT; ++k)
            transfer.indirect[channel][k] = 0.0;
        uint row = 0u, column = 0u;
        uint layers = channel == 0u ? TRANSFER_FIRST_LAYERS(ORDER) : TRANSFER_FURTHER_LAYERS(ORDER);
        for (uint layer = 0u; layer < layers; ++layer)
            add_entries(transfer, outgoing, filtered_layer(transfer_map, area, first + layer),
                        channel, layer, row, column);
        first += layers;
    }
    transfer.cosine = TRANSFER_COSINE * outgoing.polynomials[0];
    transfer.lacking = product_with_lacking(outgoing);
    transfer.visible = visible_area(transfer, outgoing);
    return transfer;
}

// Of light between facets, by albedo: sums of powers, each less than the one before by the same
// factor.
vec3 indirect_share(vec3 albedo) {
    return albedo * albedo * (1.0 - closure.persistence) / (1.0 - albedo * closure.persistence);
}

// What reaches the viewer: of light at once, and of light between facets.
struct reflected_light {
    vec3 direct;
    vec3 indirect;
};

// Adds a channel's.
void reflect_channel(inout reflected_light reflected, uint channel, transfer_light light) {
    uint of_map = COLOURED ? channel : 0u;
    vec2 sum = vec2(0.0, COLOURED ? 0.0 : closing_light(light));
    for (uint k = 0u; k < ORDER; ++k)
        sum.x += light.functions[k] * drawn.transfer.direct[of_map][k];
    for (uint k = 0u; k < TRANSFER_INDIRECT; ++k)
        sum.y += light.polynomials[k] * drawn.transfer.indirect[of_map][k];
    reflected.direct[channel] = sum.x;
    reflected.indirect[channel] = sum.y;
}

reflected_light reflect_light(transfer_light light) {
    reflected_light reflected;
    reflect_channel(reflected, 0u, light);
    reflected.direct = reflected.direct.rrr;
    reflected.indirect = reflected.indirect.rrr;
    for (uint channel = 1u; channel < CHANNELS; ++channel)
        reflect_channel(reflected, channel, light);
    return reflected;
}

vec3 mirrored_part(base_material base) {
    return MODEL == MODEL_MICROFACET ? clamp(base.specular, 0.0, 1.0) : vec3(0.0);
}

// By how much the colours of what a pixel sees differ from those that are in the map of transfer:
// those of the vertices, and, where a pixel is smaller than its texels, of the material's maps.
vec3 tint_of(base_material base, surface_point surface) {
    vec3 tint = VERTEX_COLOUR ? surface.colour.rgb : vec3(1.0);
    if (!MAGNIFIED)
        return tint;
    vec2 size = 2.0 * vec2(textureSize(transfer_map, 0).xy);
    float level = area_over(map_coordinates(MAP_HEIGHT, surface.coordinates, 1.0),
                            map_coordinates(MAP_HEIGHT, surface.coordinates_dx, 0.0),
                            map_coordinates(MAP_HEIGHT, surface.coordinates_dy, 0.0), size, true)
                      .level;
    vec3 found = (base.diffuse + 0.01) / (tint * drawn.transfer.colour + 0.01);
    return tint * mix(min(found, 4.0), vec3(1.0), min(level, 1.0));
}

// Radiance of diffuse facets. `passed`: the part of light that is not mirrored. What is mirrored
// and meets other facets is taken to go on as if it were diffuse.
vec3 diffuse_radiance(base_material base, vec3 passed, surface_point surface,
                      reflected_light reflected) {
    vec3 sum;
    if (COLOURED) {
        vec3 tint = tint_of(base, surface);
        sum = tint * (passed * reflected.direct + tint * reflected.indirect);
    } else {
        vec3 albedo = clamp(base.diffuse * passed, 0.0, 1.0);
        vec3 share = indirect_share(albedo) + indirect_share(mirrored_part(base));
        sum = albedo * reflected.direct + share * reflected.indirect;
    }
    return max(sum, 0.0) / (drawn.viewer.z * drawn.transfer.visible);
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
    float seen = direction.z * visible_area(drawn.transfer, light_from(direction));
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
        drawn.lights[i] = no_light();
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

// Of facets that are seen and lit by parts, over the area that the viewer sees.
vec3 mirrored_by_facets(base_material base, vec3 fresnel, vec3 outgoing, vec3 incoming,
                        uint light) {
    return mirrored_light(base, drawn.lights[light], fresnel, outgoing, incoming) *
           (seen_by_both(drawn.seen, drawn.shone_on[light]) /
            (drawn.viewer.z * drawn.transfer.visible));
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
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 lobes, fresnel = vec3(0.0);
    if (has_facets()) {
        fresnel = fresnel_schlick(base.specular, vec3(1.0),
                                  dot(incoming, half_vector(incoming, surface.outgoing)));
        lobes = mirrored_by_facets(fetched.base, fresnel, surface.outgoing, incoming, light);
    } else {
        base_material mirroring = base;
        mirroring.diffuse = vec3(0.0);
        lobes = evaluate_base_material(mirroring, fetched.mean_normal, surface.outgoing, incoming);
    }
    return lobes +
           diffuse_radiance(base, 1.0 - fresnel, surface, reflect_light(light_from(incoming)));
}

#ifdef ENVIRONMENT
// The environment's coefficients, of each channel: sums over the texels of a coarse level. What
// these sums are off for light that is the same everywhere is added with the mean radiance.
const int LIGHT_WIDTH = 8;

void light_of_environment(surface_point surface, out transfer_light light[3]) {
    mat3 tangent_from_environment = tangent_from_environment_of(surface);
    int level = level_of_faces(LIGHT_WIDTH);
    int size = textureSize(environment_faces, level).x;
    float sums[16];
    for (int k = 0; k < 16; ++k)
        light[0].polynomials[k] = light[1].polynomials[k] = light[2].polynomials[k] = sums[k] =
            0.0;
    vec4 mean = vec4(0.0); // radiance times cosine, cosine
    for (int i = 0; i < 6 * size * size; ++i) {
        int face = i / (size * size);
        ivec2 texel = ivec2(i % size, (i / size) % size);
        float polynomials[16];
        transfer_polynomials(tangent_from_environment * cube_texel_direction(face, texel, size),
                             polynomials);
        float solid_angle = cube_texel_solid_angle(texel, size);
        vec3 irradiance = texelFetch(environment_faces, ivec3(texel, face), level).rgb *
                          (environment.intensity * solid_angle);
        mean += vec4(irradiance, solid_angle) * polynomials[0];
        for (int k = 0; k < 16; ++k) {
            sums[k] += solid_angle * polynomials[k];
            light[0].polynomials[k] += irradiance.r * polynomials[k];
            light[1].polynomials[k] += irradiance.g * polynomials[k];
            light[2].polynomials[k] += irradiance.b * polynomials[k];
        }
    }
    mean /= max(mean.w, 1e-6);
    for (int channel = 0; channel < 3; ++channel) {
        for (int k = 0; k < 16; ++k)
            light[channel].polynomials[k] += mean[channel] * (TRANSFER_INTEGRAL[k] - sums[k]);
        find_functions(light[channel]);
    }
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
    base_material white = base;
    white.diffuse = vec3(1.0);
    transfer_light light[3];
    light_of_environment(surface, light);
    gather_relief(fetched, surface);
    reflected_light reflected;
    for (uint channel = 0u; channel < 3u; ++channel)
        reflect_channel(reflected, channel, light[channel]);
    return (has_facets() ? reflect_facets_of_relief(fetched, surface)
                         : reflect_base_specular(surface, base)) +
           diffuse_radiance(base, let_through(surface, white), surface, reflected);
}
#endif
