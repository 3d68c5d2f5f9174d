// The diffuse light of a material's relief, with its shadows and the light between its facets, from
// a map of transfer (interface/displacement/relief.h): radiance is a form of two directions, whose
// coefficients are means over facets and may be averaged like colours. After Wu, Zhao, Yan,
// Ramamoorthi, 2019, Accurate Appearance Preserving Prefiltering for Rendering Displacement-Mapped
// Surfaces, whose scaling functions it replaces.
//
// Microfacets are those of the relief's facets, whose normals are kept in bins; the maps' normals
// count only for half-vector lobes and for materials without a relief, which are shaded as by
// `toksvig`.
//
// Where a pixel sees less than a cell of the map's finest level, a ray finds the facet that it
// sees, with the heights' own shadows.

#include "shading/averaged_maps.glsl"
#include "interface/displacement/relief.h"
#include "lib/displacement/transfer_basis.glsl"
#include "lib/displacement/transfer_light.glsl"
#include "lib/displacement/facet_bins.glsl"
#include "filters/displaced/relief_surface.glsl"
#include "filters/displaced/seen_relief.glsl"

const bool BIN_COLOUR = false;
const bool BIN_WIDTHS = false;

#include "filters/displaced/mirrored_light.glsl"

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;
layout(constant_id = SPECIALISE_TRANSFER_COLOURED) const bool COLOURED = false;
layout(constant_id = SPECIALISE_TRANSFER_MAGNIFIED) const bool MAGNIFIED = false;

layout(LOBE_DESCRIPTOR(36)) uniform sampler2DArray transfer_map;
layout(LOBE_DESCRIPTOR(37), std140) uniform closure_block {
    transfer_closure_constants closure;
};
layout(LOBE_DESCRIPTOR(38)) uniform sampler2DArray facet_map;

// Whether the relief's facets mirror light.
const bool FACETS = RELIEF && MODEL == MODEL_MICROFACET;
// Whether pixels may see single facets. Displaced triangles are drawn where these are.
const bool NEAR = RELIEF && MAGNIFIED && !DISPLACED;

const uint CHANNELS = COLOURED ? 3u : 1u;
const uint DIRECT_ENTRIES = TRANSFER_DIRECT_COUNT(ORDER);
const uint FIRST_LAYERS = TRANSFER_FIRST_LAYERS(ORDER);
const uint FURTHER_LAYERS = TRANSFER_FURTHER_LAYERS(ORDER);
// The visible area is last.
const uint LAYERS = COLOURED ? FIRST_LAYERS + 2u * FURTHER_LAYERS
                             : (FACETS ? FIRST_LAYERS : FURTHER_LAYERS);

// Cells that see less of the sky than this are lit by other facets, as the flat carrier by the sky.
const float LEAST_LIT = 0.05;

// Light towards a viewer, by the light's polynomials, of each channel: a white relief's (or the
// coloured one's) at once, and what it gets from other facets as well. Sums over the map's
// functions are written as sums over the polynomials that these consist of, so that a light only
// needs its polynomials.
struct reflected_form {
    float direct[3][16];
    float indirect[3][16];
    float seen; // the area that the viewer sees of the facets
};

// The facet that a pixel sees.
struct near_facet {
    float share; // 0: the pixel sees many
    relief_hit hit;
    surface_point surface;
    base_material base;
};

// What a pixel's lights share.
struct relief_footprint {
    vec3 viewer;
    reflected_form form; // over the area that is seen
    float area[16];      // that is seen of the facets, by the viewer's polynomials
    vec3 colour;         // the mean diffuse colour, if it varies
    float visible;       // the area that the viewer sees, over the map's mean of it
    float seen;          // of the facets' area that faces the viewer
    light_sum lights[4];
    float shone_on[4]; // of the facets' area that faces the light
    near_facet near;
};
relief_footprint drawn;

vec2 transfer_size() {
    return 2.0 * vec2(textureSize(transfer_map, 0).xy);
}

// Quads lie between the centres of texels, half a texel further than these.
map_area transfer_area(surface_point surface) {
    vec2 size = transfer_size();
    map_area area = area_of(MAP_HEIGHT, size, surface);
    area.centre -= 0.5 / size;
    return area;
}

// ---------------------------------------------------------------------------------------------
// A facet from near

// A pixel of one texel and less sees a facet; from two texels on, cells.
float share_of_facet(surface_point surface) {
    vec2 size = transfer_size();
    footprint pixel = footprint_of(map_coordinates(MAP_HEIGHT, surface.coordinates_dx, 0.0) * size,
                                   map_coordinates(MAP_HEIGHT, surface.coordinates_dy, 0.0) * size);
    return clamp(1.0 - log2(max(pixel.major_axis, 1e-6)) - knobs.level_bias, 0.0, 1.0);
}

void find_near_facet(surface_point surface) {
    drawn.near.share = share_of_facet(surface);
    if (drawn.near.share == 0.0)
        return;
    drawn.near.hit = seen_point(surface);
    if (!drawn.near.hit.found) { // beyond the longest walk
        drawn.near.share = 0.0;
        return;
    }
    drawn.near.surface = surface_at(surface, drawn.near.hit.position);
    drawn.near.base = filtered_material(drawn.near.surface,
                                        relief_from_tangent(drawn.near.hit.normal),
                                        lobe_area(drawn.near.surface));
}

bool facet_sees(vec3 direction) {
    vec3 towards = relief_from_tangent(direction);
    return dot(drawn.near.hit.normal, towards) > 0.0 &&
           sees_sky(drawn.near.hit.position, towards);
}

// Of a light, without what reaches the facet from others.
vec3 reflected_by_near_facet(vec3 outgoing, vec3 incoming) {
    base_material base = drawn.near.base;
    return facet_sees(incoming) ? evaluate_base_material(base, base.normal, outgoing, incoming)
                                : vec3(0.0);
}

// ---------------------------------------------------------------------------------------------
// Cells

vec4 transfer_layers[LAYERS];

void fetch_transfer(map_area area) {
    for (uint layer = 0u; layer < LAYERS; ++layer)
        transfer_layers[layer] = vec4(0.0);
    for (uint i = 0u; i < probes_of(area); ++i)
        for (uint layer = 0u; layer < LAYERS; ++layer)
            transfer_layers[layer] += fetch_probe(transfer_map, layer, area, i);
    float share = 1.0 / float(probes_of(area));
    for (uint layer = 0u; layer < LAYERS; ++layer)
        transfer_layers[layer] *= share;
}

float entry(uint place) {
    return transfer_layers[place / 4u][place % 4u];
}

// Of a symmetric matrix that begins at an entry.
float entry_of_matrix(uint first, uint i, uint j) {
    uint row = max(i, j), column = min(i, j);
    return entry(first + row * (row + 1u) / 2u + column);
}

float function_factor(uint function, uint polynomial) {
    return closure.basis.functions[4u * function + polynomial / 4u][polynomial % 4u];
}

// Factors of the map's functions, as those of the polynomials.
void in_polynomials(float functions[ORDER], out float polynomials[16]) {
    for (uint i = 0u; i < 16u; ++i) {
        polynomials[i] = 0.0;
        for (uint k = 0u; k < ORDER; ++k)
            polynomials[i] += function_factor(k, i) * functions[k];
    }
}

float product(float a[16], float b[16]) {
    float sum = 0.0;
    for (uint i = 0u; i < 16u; ++i)
        sum += a[i] * b[i];
    return sum;
}

float product_with(vec4 factors[4], float polynomials[16]) {
    float sum = 0.0;
    for (uint i = 0u; i < 16u; ++i)
        sum += factors[i / 4u][i % 4u] * polynomials[i];
    return sum;
}

// An area that is seen from a direction, over the map's mean of it.
float relative_area(float area, float polynomials[16]) {
    return max(area / max(product_with(closure.visible, polynomials), 1e-6), LEAST_VISIBLE);
}

// Adds the closure: (d u^T + u d^T) / pi - u u^T (1^T d) / pi^2, with d what lacks, u the cosine.
void close(inout reflected_form form, float viewer[16]) {
    float cosine = INVERSE_PI * TRANSFER_COSINE * viewer[0];
    for (uint i = 0u; i < 16u; ++i)
        form.indirect[0][i] += cosine * closure.lacking[i / 4u][i % 4u];
    form.indirect[0][0] += TRANSFER_COSINE * (INVERSE_PI * product_with(closure.lacking, viewer) -
                                              INVERSE_PI * closure.lost * cosine);
}

void gather_channel(inout reflected_form form, uint channel, float viewer[16],
                    float functions[ORDER]) {
    uint first = channel == 0u ? 0u : 4u * (FIRST_LAYERS + (channel - 1u) * FURTHER_LAYERS);
    float direct[ORDER];
    for (uint i = 0u; i < ORDER; ++i) {
        direct[i] = 0.0;
        for (uint j = 0u; j < ORDER; ++j)
            direct[i] += entry_of_matrix(first, i, j) * functions[j];
    }
    in_polynomials(direct, form.direct[channel]);
    for (uint i = 0u; i < 16u; ++i)
        form.indirect[channel][i] = 0.0;
    for (uint i = 0u; i < TRANSFER_INDIRECT; ++i)
        for (uint j = 0u; j < TRANSFER_INDIRECT; ++j)
            form.indirect[channel][i] += entry_of_matrix(first + DIRECT_ENTRIES, i, j) * viewer[j];
    drawn.colour[channel] = entry(first + DIRECT_ENTRIES + TRANSFER_INDIRECT_COUNT);
}

// What a white relief reflects of a white sky is the area that is seen of it. Of a few facets, the
// area by the map's functions may be far from it, and then radiance would be, too.
float white_light(reflected_form form) {
    float sum = 0.0;
    for (uint i = 0u; i < 16u; ++i)
        sum += TRANSFER_INTEGRAL[i] * (form.direct[0][i] + form.indirect[0][i]);
    return sum;
}

float visible_area(float functions[ORDER]) {
    float sum = 0.0;
    for (uint k = 0u; k < ORDER; ++k)
        sum += entry(TRANSFER_ENTRIES(ORDER) + k) * functions[k];
    return sum;
}

void in_functions(float polynomials[16], out float functions[ORDER]) {
    for (uint k = 0u; k < ORDER; ++k) {
        functions[k] = 0.0;
        for (uint i = 0u; i < 16u; ++i)
            functions[k] += function_factor(k, i) * polynomials[i];
    }
}

// `viewer`: a direction's polynomials, or a sum of such.
reflected_form form_of(float viewer[16]) {
    float functions[ORDER];
    in_functions(viewer, functions);
    reflected_form form;
    for (uint channel = 0u; channel < CHANNELS; ++channel)
        gather_channel(form, channel, viewer, functions);
    if (!COLOURED)
        close(form, viewer);
    form.seen = COLOURED ? visible_area(functions) : white_light(form);
    return form;
}

// N is symmetric: half of it is what light the viewer's side gets from other facets, and half what
// these get from the light that shines on it. To viewers everywhere, a facet shows the first alone,
// 1^T b o^T, which is 2 N less 1^T o b^T, a multiple of 1^T C.
void leave_what_arrives(inout reflected_form form, uint channel) {
    float indirect = 0.0, direct = 0.0;
    for (uint i = 0u; i < 16u; ++i)
        indirect += TRANSFER_INTEGRAL[i] * form.indirect[channel][i];
    for (uint i = 0u; i < TRANSFER_INDIRECT; ++i)
        direct += TRANSFER_INTEGRAL[i] * form.direct[channel][i];
    float part = 1.0 / max(direct, LEAST_LIT);
    for (uint i = 0u; i < 16u; ++i)
        form.indirect[channel][i] *= 1.0 + max(part * direct, 0.0);
    for (uint i = 0u; i < TRANSFER_INDIRECT && direct > 0.0; ++i)
        form.indirect[channel][i] -= part * indirect * form.direct[channel][i];
}

// To viewers everywhere: the mean over their cosines.
reflected_form form_of_all() {
    float viewers[16];
    for (uint i = 0u; i < 16u; ++i)
        viewers[i] = INVERSE_PI * TRANSFER_INTEGRAL[i];
    reflected_form form = form_of(viewers);
    for (uint channel = 0u; channel < CHANNELS; ++channel)
        leave_what_arrives(form, channel);
    float lacking = max(LEAST_LIT - form.seen, 0.0);
    for (uint channel = 0u; channel < CHANNELS; ++channel)
        form.indirect[channel][0] +=
            lacking * INVERSE_PI * TRANSFER_COSINE *
            (COLOURED ? drawn.colour[channel] * drawn.colour[channel] : 1.0);
    form.seen += lacking;
    return form;
}

// drawn.form: so much of what it is, of light at once and of light between facets, and of another.
void mix_form(vec2 factors, reflected_form other, vec2 of_other) {
    for (uint channel = 0u; channel < CHANNELS; ++channel) {
        for (uint i = 0u; i < 16u; ++i) {
            drawn.form.direct[channel][i] = factors.x * drawn.form.direct[channel][i] +
                                            of_other.x * other.direct[channel][i];
            drawn.form.indirect[channel][i] = factors.y * drawn.form.indirect[channel][i] +
                                              of_other.y * other.indirect[channel][i];
        }
    }
}

// Divides by the area that is seen. Where that is small, a cell shows what it shows to others, and
// so does a facet; `lit`: by light at once, for which no ray is followed.
void divide_form(bool lit) {
    float lacking = max(LEAST_VISIBLE * drawn.viewer.z - drawn.form.seen, 0.0);
    float near = NEAR ? drawn.near.share : 0.0;
    float scale = (1.0 - near) / (drawn.form.seen + lacking);
    if (lacking == 0.0 && near == 0.0) {
        mix_form(vec2(scale), drawn.form, vec2(0.0));
        return;
    }
    reflected_form of_all = form_of_all();
    float hidden = lacking * scale;
    mix_form(vec2(scale), of_all, vec2(hidden + (lit ? near : 0.0), hidden + near) / of_all.seen);
}

void gather_relief(surface_point surface, bool lit) {
    drawn.viewer = viewer_of(surface);
    map_area at = transfer_area(surface);
    if (NEAR) {
        find_near_facet(surface);
        if (drawn.near.share > 0.0)
            at.centre += drawn.near.share *
                         map_coordinates(MAP_HEIGHT, drawn.near.surface.coordinates -
                                                         surface.coordinates, 0.0);
    }
    fetch_transfer(at);
    float viewer[16];
    transfer_polynomials(drawn.viewer, viewer);
    drawn.form = form_of(viewer);
    if (FACETS) {
        float functions[ORDER], area[ORDER];
        in_functions(viewer, functions);
        for (uint k = 0u; k < ORDER; ++k)
            area[k] = entry(TRANSFER_ENTRIES(ORDER) + k);
        drawn.visible = relative_area(visible_area(functions), viewer);
        in_polynomials(area, drawn.area);
    }
    divide_form(lit);
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

// Of light of each channel, by its polynomials.
void reflect_channel(inout reflected_light reflected, uint channel, float light[16]) {
    uint of_map = COLOURED ? channel : 0u;
    reflected.direct[channel] = product(drawn.form.direct[of_map], light);
    reflected.indirect[channel] = product(drawn.form.indirect[of_map], light);
}

reflected_light reflect_light(vec3 incoming) {
    float light[16];
    transfer_polynomials(incoming, light);
    reflected_light reflected;
    reflect_channel(reflected, 0u, light);
    reflected.direct = reflected.direct.rrr;
    reflected.indirect = reflected.indirect.rrr;
    for (uint channel = 1u; channel < CHANNELS; ++channel)
        reflect_channel(reflected, channel, light);
    // Where facets are few and steep, the functions overshoot: without a bound by tens of times.
    reflected.direct = min(reflected.direct, vec3(INVERSE_PI));
    reflected.indirect = min(reflected.indirect, vec3(INVERSE_PI));
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
    float level = area_over(map_coordinates(MAP_HEIGHT, surface.coordinates, 1.0),
                            map_coordinates(MAP_HEIGHT, surface.coordinates_dx, 0.0),
                            map_coordinates(MAP_HEIGHT, surface.coordinates_dy, 0.0),
                            transfer_size(), true).level;
    vec3 found = (base.diffuse + 0.01) / (tint * drawn.colour + 0.01);
    return tint * mix(min(found, 4.0), vec3(1.0), min(level, 1.0));
}

// Radiance of diffuse facets. `passed`: the part of light that is not mirrored. What is mirrored
// and meets other facets is taken to go on as if it were diffuse.
vec3 diffuse_radiance(base_material base, vec3 passed, surface_point surface,
                      reflected_light reflected) {
    if (NEAR && drawn.near.share > 0.0)
        base.diffuse = mix(base.diffuse, drawn.near.base.diffuse, drawn.near.share);
    vec3 sum;
    if (COLOURED) {
        vec3 tint = tint_of(base, surface);
        sum = tint * (passed * reflected.direct + tint * reflected.indirect);
    } else {
        vec3 albedo = clamp(base.diffuse * passed, 0.0, 1.0);
        vec3 share = indirect_share(albedo) + indirect_share(mirrored_part(base));
        sum = albedo * reflected.direct + share * reflected.indirect;
    }
    return max(sum, 0.0);
}

// ---------------------------------------------------------------------------------------------
// Microfacets of the facets

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
    areas.normals[index] = normal_spread_of(bin.mean, bin.places + second_moments_of(bin.mean));
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
    float polynomials[16];
    transfer_polynomials(direction, polynomials);
    float seen = direction.z * relative_area(product(drawn.area, polynomials), polynomials);
    return clamp(seen / max(facing, 1e-6), 0.0, 1.0);
}

// What both directions see, if heights decide: Smith's masking with correlated heights, 1 / (1 +
// Lambda + Lambda'), written with 1 / (1 + Lambda) of both.
float seen_by_both(float first, float second) {
    return first * second / max(first + second - first * second, 1e-6);
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
           (seen_by_both(drawn.seen, drawn.shone_on[light]) / (drawn.viewer.z * drawn.visible));
}

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
    if (has_diffuse())
        gather_relief(surface, false);
    if (FACETS)
        gather_facets(fetched, surface, incoming);
}

vec3 evaluate_appearance(appearance fetched, surface_point surface, vec3 incoming, uint light) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return evaluate_base_material(base, fetched.mean_normal, surface.outgoing, incoming);
    if (incoming.z <= 0.0)
        return vec3(0.0);
    vec3 lobes, fresnel = vec3(0.0);
    if (FACETS) {
        fresnel = fresnel_schlick(base.specular, vec3(1.0),
                                  dot(incoming, half_vector(incoming, surface.outgoing)));
        lobes = mirrored_by_facets(fetched.base, fresnel, surface.outgoing, incoming, light);
    } else {
        base_material mirroring = base;
        mirroring.diffuse = vec3(0.0);
        lobes = evaluate_base_material(mirroring, fetched.mean_normal, surface.outgoing, incoming);
    }
    vec3 of_cells = diffuse_radiance(base, 1.0 - fresnel, surface, reflect_light(incoming));
    if (!NEAR || drawn.near.share == 0.0)
        return lobes + of_cells;
    return (1.0 - drawn.near.share) * lobes + of_cells +
           drawn.near.share * reflected_by_near_facet(surface.outgoing, incoming);
}

#ifdef ENVIRONMENT
// The environment's integrals with the polynomials, of each channel.
void light_of_environment(surface_point surface, out float light[3][16]) {
    mat3 tangent_from_environment = tangent_from_environment_of(surface);
    hemisphere_moments moments = hemisphere_moments_about(
        hemisphere_moments_map, transpose(tangent_from_environment)[2]);
    transfer_polynomials_of_light(moments.red, tangent_from_environment, light[0]);
    transfer_polynomials_of_light(moments.green, tangent_from_environment, light[1]);
    transfer_polynomials_of_light(moments.blue, tangent_from_environment, light[2]);
    for (int channel = 0; channel < 3; ++channel)
        for (int k = 0; k < 16; ++k)
            light[channel][k] *= environment.intensity;
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
    return sum / (drawn.viewer.z * drawn.visible);
}

// What it mirrors of other facets is lost here: it is part of the light between these.
vec3 mirrored_by_near_facet(surface_point surface) {
    return facet_sees(reflect(-surface.outgoing, drawn.near.base.normal))
               ? reflect_base_specular(drawn.near.surface, drawn.near.base)
               : vec3(0.0);
}

vec3 reflect_environment(appearance fetched, surface_point surface) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return reflect_base_material(surface, base, fetched.mean_normal);
    base_material white = base;
    white.diffuse = vec3(1.0);
    float light[3][16];
    light_of_environment(surface, light);
    gather_relief(surface, true);
    reflected_light reflected;
    for (uint channel = 0u; channel < 3u; ++channel)
        reflect_channel(reflected, channel, light[channel]);
    vec3 lobes = FACETS ? reflect_facets_of_relief(fetched, surface)
                        : reflect_base_specular(surface, base);
    if (NEAR && drawn.near.share > 0.0)
        lobes = mix(lobes, mirrored_by_near_facet(surface), drawn.near.share);
    return lobes + diffuse_radiance(base, let_through(surface, white), surface, reflected);
}
#endif
