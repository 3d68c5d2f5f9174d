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
#include "lib/map/slope_stretch.glsl"
#include "filters/displaced/relief_frame.glsl"
#include "filters/displaced/relief_surface.glsl"
#include "filters/displaced/seen_relief.glsl"

const bool BIN_COLOUR = false;
const bool BIN_WIDTHS = false;

#include "filters/displaced/mirrored_light.glsl"
#include "lib/displacement/second_facets.glsl"
#include "lib/microfacet/facing_area.glsl"
#include "filters/displaced/light_sent_on.glsl"
#include "filters/displaced/two_widths.glsl"
#include "filters/leadr/base_lobe_map.glsl"

layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;
layout(constant_id = SPECIALISE_TRANSFER_COLOURED) const bool COLOURED = false;
layout(constant_id = SPECIALISE_TRANSFER_MAGNIFIED) const bool MAGNIFIED = false;
layout(constant_id = SPECIALISE_TRANSFER_WIDTHS) const bool WIDTHS_ON_RELIEF = false;
layout(constant_id = SPECIALISE_TRANSFER_EMISSION) const bool EMISSIVE = false;

layout(LOBE_DESCRIPTOR(36)) uniform sampler2DArray transfer_map;
layout(LOBE_DESCRIPTOR(37), std140) uniform closure_block {
    transfer_closure_constants closure;
};
layout(LOBE_DESCRIPTOR(38)) uniform sampler2DArray facet_map;

// Whether the relief's facets mirror light.
const bool FACETS = RELIEF && MODEL == MODEL_MICROFACET;
// Widths of microfacets that are shaded.
const bool WIDTHS_VARY = WIDTHS_APART || BASE_LOBES != BASE_LOBES_ALIKE;
const uint WIDTHS = FACETS && WIDTHS_VARY ? 2u : 1u;
// Whether each of them has facets of its own: all maps lie on the relief as its heights do.
const bool WIDTHS_SPLIT = WIDTHS == 2u && WIDTHS_ON_RELIEF;
// Whether pixels may see single facets. Displaced triangles are drawn where these are.
const bool NEAR = RELIEF && MAGNIFIED && !DISPLACED;

const uint DIRECT_ENTRIES = TRANSFER_DIRECT_COUNT(ORDER);
const uint FIRST_LAYERS = TRANSFER_FIRST_LAYERS(ORDER);
const uint FURTHER_LAYERS = TRANSFER_FURTHER_LAYERS(ORDER);
// The visible area is last.
const uint LAYERS = COLOURED || FACETS ? TRANSFER_CHANNEL_LAYERS(ORDER, COLOURED) : FURTHER_LAYERS;

// Layers of emission begin here.
const uint FIRST_EMISSION = TRANSFER_CHANNEL_LAYERS(ORDER, COLOURED);

// Cells that see less of the sky than this are lit by other facets, as the flat carrier by the sky.
const float LEAST_LIT = 0.05;

// At most this many times as much of mirrored light as of diffuse light meets other facets; and of
// diffuse light no less than this part is taken to do so.
const float MOST_MIRRORED_ON = 4.0;
const float LEAST_INDIRECT = 0.01;

// Factors of the 16 polynomials, or their values, in the map's frame.
struct polynomials {
    vec4 terms[4];
};

// Light towards a viewer, by the light's polynomials, of one channel: a white relief's (or the
// coloured one's) at once, and what it gets from other facets as well. Sums over the map's
// functions are written as sums over the polynomials that these consist of, so that a light only
// needs its polynomials.
struct channel_form {
    polynomials direct;
    polynomials indirect;
};

// Of a relief without colours, red alone. No loop goes over channels: drivers that do not unroll
// it would keep all of this in memory.
struct reflected_form {
    channel_form red, green, blue;
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
    polynomials area;    // that is seen of the facets, by products of a direction's coordinates
    polynomials mean_area; // the map's mean of it
    vec3 colour;         // the mean diffuse colour, if it varies
    float visible;       // the area that the viewer sees, over the map's mean of it
    float seen;          // of the facets' area that faces the viewer
    float widths[WIDTHS]; // parameters of the distribution
    float shares[WIDTHS]; // of what is mirrored
    two_widths two;       // the same, where they are two
    light_sum lights[4u * WIDTHS];
    vec3 mirrored;      // what facets mirror of light from everywhere
    float mirrored_on;  // how much of that meets other facets, relative to diffuse light
    sent_on_lobe sent_on; // where that comes from if they are smooth
    near_facet near;
};
relief_footprint drawn;

vec2 transfer_size() {
    return 2.0 * vec2(textureSize(transfer_map, 0).xy);
}

vec2 relief_texels() {
    return transfer_size();
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
                                        tangent_from_relief(drawn.near.hit.normal),
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

// The carrier's point, moved towards the facet by the share that it has of the pixel.
surface_point seen_surface(surface_point surface) {
    if (drawn.near.share > 0.0)
        surface.coordinates += drawn.near.share *
                               (drawn.near.surface.coordinates - surface.coordinates);
    return surface;
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

polynomials polynomials_from(float y[16]) {
    polynomials result;
    for (uint i = 0u; i < 4u; ++i)
        result.terms[i] = vec4(y[4u * i], y[4u * i + 1u], y[4u * i + 2u], y[4u * i + 3u]);
    return result;
}

polynomials polynomials_of(vec3 direction) {
    float y[16];
    transfer_polynomials(map_from_tangent(direction), y);
    return polynomials_from(y);
}

polynomials integrals_of_polynomials() {
    return polynomials_from(TRANSFER_INTEGRAL);
}

float product(polynomials a, polynomials b) {
    return dot(a.terms[0], b.terms[0]) + dot(a.terms[1], b.terms[1]) +
           dot(a.terms[2], b.terms[2]) + dot(a.terms[3], b.terms[3]);
}

polynomials scaled(polynomials a, float factor) {
    for (uint i = 0u; i < 4u; ++i)
        a.terms[i] *= factor;
    return a;
}

polynomials sum_of(polynomials a, float of_a, polynomials b, float of_b) {
    for (uint i = 0u; i < 4u; ++i)
        a.terms[i] = of_a * a.terms[i] + of_b * b.terms[i];
    return a;
}

// Of the map, but for the first, which is the first polynomial; the others have nothing of it.
polynomials function_of(uint k) {
    polynomials result;
    for (uint i = 0u; i < 4u; ++i)
        result.terms[i] = closure.basis.functions[4u * k + i];
    result.terms[0].x = 0.0;
    return result;
}

// Factors of the map's functions, as those of the polynomials.
polynomials in_polynomials(float functions[ORDER]) {
    polynomials sum = scaled(function_of(1u), functions[1]);
    for (uint k = 2u; k < ORDER; ++k)
        sum = sum_of(sum, 1.0, function_of(k), functions[k]);
    sum.terms[0].x = functions[0];
    return sum;
}

void in_functions(polynomials values, out float functions[ORDER]) {
    functions[0] = values.terms[0].x;
    for (uint k = 1u; k < ORDER; ++k)
        functions[k] = product(function_of(k), values);
}

// An area that is seen from a direction, over the map's mean of it.
float relative_area(float area, polynomials direction) {
    return max(area / max(product(polynomials(closure.visible), direction), 1e-6), LEAST_VISIBLE);
}

// Adds the closure: (d u^T + u d^T) / pi - u u^T (1^T d) / pi^2, with d what lacks, u the cosine.
// `cells`: see form_of().
void close(inout channel_form form, polynomials viewer, float cells) {
    polynomials lacking = scaled(polynomials(closure.lacking), cells);
    float cosine = INVERSE_PI * TRANSFER_COSINE * viewer.terms[0].x;
    form.indirect = sum_of(form.indirect, 1.0, lacking, cosine);
    form.indirect.terms[0].x +=
        TRANSFER_COSINE *
        (INVERSE_PI * product(lacking, viewer) - INVERSE_PI * cells * closure.lost * cosine);
}

// Where a channel's begin.
uint first_entry(uint channel) {
    return channel == 0u ? 0u : 4u * (FIRST_LAYERS + (channel - 1u) * FURTHER_LAYERS);
}

channel_form gather_channel(uint channel, polynomials viewer, float functions[ORDER]) {
    uint first = first_entry(channel);
    float direct[ORDER];
    for (uint i = 0u; i < ORDER; ++i) {
        direct[i] = 0.0;
        for (uint j = 0u; j < ORDER; ++j)
            direct[i] += entry_of_matrix(first, i, j) * functions[j];
    }
    channel_form form;
    form.direct = in_polynomials(direct);
    form.indirect.terms = vec4[4](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint i = 0u; i < TRANSFER_INDIRECT; ++i)
        for (uint j = 0u; j < TRANSFER_INDIRECT; ++j)
            form.indirect.terms[0][i] +=
                entry_of_matrix(first + DIRECT_ENTRIES, i, j) * viewer.terms[0][j];
    return form;
}

// What a white relief reflects of a white sky is the area that is seen of it. Of a few facets, the
// area by the map's functions may be far from it, and then radiance would be, too.
float white_light(channel_form form) {
    return product(integrals_of_polynomials(), sum_of(form.direct, 1.0, form.indirect, 1.0));
}

float visible_area(float functions[ORDER]) {
    float sum = 0.0;
    for (uint k = 0u; k < ORDER; ++k)
        sum += entry(TRANSFER_ENTRIES(ORDER) + k) * functions[k];
    return sum;
}

// `viewer`: the polynomials of a direction, or a sum of such, and the same in the map's functions.
// `cells`: how many the sum over cells is of, by area.
reflected_form form_of(polynomials viewer, float functions[ORDER], float cells) {
    reflected_form form;
    form.red = gather_channel(0u, viewer, functions);
    if (COLOURED) {
        form.green = gather_channel(1u, viewer, functions);
        form.blue = gather_channel(2u, viewer, functions);
        form.seen = visible_area(functions);
    } else {
        close(form.red, viewer, cells);
        form.seen = white_light(form.red);
    }
    return form;
}

// N is symmetric: half of it is what light the viewer's side gets from other facets, and half what
// these get from the light that shines on it. To viewers everywhere, a facet shows the first alone,
// 1^T b o^T, which is 2 N less 1^T o b^T, a multiple of 1^T C.
void leave_what_arrives(inout channel_form form) {
    polynomials integrals = integrals_of_polynomials();
    float indirect = product(integrals, form.indirect);
    float direct = dot(integrals.terms[0], form.direct.terms[0]); // of the smooth ones
    float part = 1.0 / max(direct, LEAST_LIT);
    form.indirect = scaled(form.indirect, 1.0 + max(part * direct, 0.0));
    if (direct > 0.0)
        form.indirect.terms[0] -= part * indirect * form.direct.terms[0];
}

void light_evenly(inout channel_form form, float lacking, float colour) {
    form.indirect.terms[0].x += lacking * INVERSE_PI * TRANSFER_COSINE * colour * colour;
}

// To viewers everywhere: the mean over their cosines.
reflected_form form_of_all() {
    float functions[ORDER];
    for (uint k = 0u; k < ORDER; ++k)
        functions[k] = INVERSE_PI * closure.basis.integrals[k / 4u][k % 4u];
    reflected_form form = form_of(scaled(integrals_of_polynomials(), INVERSE_PI), functions, 1.0);
    float lacking = max(LEAST_LIT - form.seen, 0.0);
    leave_what_arrives(form.red);
    light_evenly(form.red, lacking, COLOURED ? drawn.colour.r : 1.0);
    if (COLOURED) {
        leave_what_arrives(form.green);
        light_evenly(form.green, lacking, drawn.colour.g);
        leave_what_arrives(form.blue);
        light_evenly(form.blue, lacking, drawn.colour.b);
    }
    form.seen += lacking;
    return form;
}

// The area that is seen of a cell, and of the map: as what a white relief reflects of a white sky
// (see white_light()), where colours do not vary.
vec2 seen_areas(polynomials viewer, float functions[ORDER]) {
    if (COLOURED)
        return vec2(visible_area(functions),
                    max(product(polynomials(closure.visible), viewer), 1e-6));
    float sum = product(polynomials(closure.lacking), viewer);
    for (uint i = 0u; i < ORDER; ++i)
        for (uint j = 0u; j < ORDER; ++j)
            sum += closure.basis.integrals[i / 4u][i % 4u] * entry_of_matrix(0u, i, j) *
                   functions[j];
    for (uint i = 0u; i < TRANSFER_INDIRECT; ++i)
        for (uint j = 0u; j < TRANSFER_INDIRECT; ++j)
            sum += TRANSFER_INTEGRAL[i] * entry_of_matrix(DIRECT_ENTRIES, i, j) *
                   viewer.terms[0][j];
    return vec2(sum, drawn.viewer.z);
}

// Adds so much of the map's mean to a cell's, as if its colours were those of the cell.
void add_cells_behind(float part) {
    for (uint channel = 0u; channel < (COLOURED ? 3u : 1u); ++channel) {
        uint first = first_entry(channel), last = first + DIRECT_ENTRIES + TRANSFER_INDIRECT_COUNT;
        float colour = part, between = part;
        if (COLOURED) {
            float factor = (entry(last) + 0.01) / (closure.mean[last / 4u][last % 4u] + 0.01);
            colour *= factor;
            // Between facets metal counts as well, which has nothing of the diffuse colour.
            // As bright a cell in a dark map has no more than its colours make of it.
            between *= METALLIC_MAP ? 1.0 : factor * min(factor, 1.0);
        }
        for (uint i = first; i < last; ++i)
            transfer_layers[i / 4u][i % 4u] +=
                (i < first + DIRECT_ENTRIES ? colour : between) * closure.mean[i / 4u][i % 4u];
    }
}

// So much of a form, of light at once and of light between facets.
void add_channel(inout channel_form form, channel_form other, vec2 of_other) {
    form.direct = sum_of(form.direct, 1.0, other.direct, of_other.x);
    form.indirect = sum_of(form.indirect, 1.0, other.indirect, of_other.y);
}

void scale_channel(inout channel_form form, float factor) {
    form.direct = scaled(form.direct, factor);
    form.indirect = scaled(form.indirect, factor);
}

// Over the area that is seen. Where that is less than the map's, which is the carrier's, the viewer
// sees other cells behind this one: the map's mean. Otherwise cells that show little of themselves
// would count as much as those that hide them. Displaced triangles hide each other by themselves.
// `lit`: a near facet is lit by light at once, for which no ray is followed.
void find_form(polynomials viewer, float functions[ORDER], bool lit) {
    float near = NEAR ? drawn.near.share : 0.0;
    reflected_form of_all;
    if (NEAR && near > 0.0)
        of_all = form_of_all();
    vec2 seen = seen_areas(viewer, functions);
    float whole = DISPLACED ? LEAST_VISIBLE * seen.y : seen.y;
    float behind = max(whole - seen.x, 0.0) / seen.y;
    if (behind > 0.0)
        add_cells_behind(behind);
    drawn.form = form_of(viewer, functions, 1.0 + behind);
    float scale = (1.0 - near) / max(seen.x, whole);
    scale_channel(drawn.form.red, scale);
    if (COLOURED) {
        scale_channel(drawn.form.green, scale);
        scale_channel(drawn.form.blue, scale);
    }
    if (NEAR && near > 0.0) {
        vec2 share = vec2(lit ? near : 0.0, near) / of_all.seen;
        add_channel(drawn.form.red, of_all.red, share);
        if (COLOURED) {
            add_channel(drawn.form.green, of_all.green, share);
            add_channel(drawn.form.blue, of_all.blue, share);
        }
    }
}

// ---------------------------------------------------------------------------------------------
// Emission

// Radiance that facets send to the viewer because they shine, and that others reflect of it.
// `near`: of the facet that a near pixel sees, which its own map says.
//
// Where a viewer sees less of a cell than of the map, the rest is what he sees behind it: as the
// cell shows to viewers everywhere, in proportion to what the map shows to him rather than to
// these.
vec3 emission_of_relief(surface_point surface, vec3 near) {
    const uint FIRST_AREA = TRANSFER_ENTRIES(ORDER) / 4u;
    map_area area = transfer_area(NEAR ? seen_surface(surface) : surface);
    vec4 seen[FIRST_LAYERS - FIRST_AREA], layers[TRANSFER_EMISSION_LAYERS(ORDER)];
    for (uint i = 0u; i < FIRST_LAYERS - FIRST_AREA; ++i)
        seen[i] = filtered_layer(transfer_map, area, FIRST_AREA + i);
    for (uint i = 0u; i < TRANSFER_EMISSION_LAYERS(ORDER); ++i)
        layers[i] = filtered_layer(transfer_map, area, FIRST_EMISSION + i);
    polynomials viewer = polynomials_of(viewer_of(surface));
    float functions[ORDER];
    in_functions(viewer, functions);
    vec3 sent = vec3(0.0), sent_to_all = vec3(0.0), of_map = vec3(0.0), of_map_to_all = vec3(0.0);
    float visible = 0.0, visible_to_all = 0.0;
    for (uint k = 0u; k < ORDER; ++k) {
        float to_all = INVERSE_PI * closure.basis.integrals[k / 4u][k % 4u];
        uint place = TRANSFER_ENTRIES(ORDER) + k - 4u * FIRST_AREA;
        visible += functions[k] * seen[place / 4u][place % 4u];
        visible_to_all += to_all * seen[place / 4u][place % 4u];
        vec3 own;
        for (uint channel = 0u; channel < 3u; ++channel) {
            uint entry = channel * TRANSFER_EMISSION(ORDER) + k;
            own[channel] = layers[entry / 4u][entry % 4u];
        }
        sent += functions[k] * own;
        sent_to_all += to_all * own;
        of_map += functions[k] * closure.emission[k].rgb;
        of_map_to_all += to_all * closure.emission[k].rgb;
    }
    vec3 of_others;
    for (uint channel = 0u; channel < 3u; ++channel) {
        uint entry = channel * TRANSFER_EMISSION(ORDER) + ORDER;
        of_others[channel] = layers[entry / 4u][entry % 4u];
    }
    visible_to_all = max(visible_to_all, LEAST_LIT);
    polynomials map = polynomials(closure.visible);
    float of_plane = max(product(map, viewer), 1e-6);
    float plane_to_all = INVERSE_PI * product(map, integrals_of_polynomials());
    vec3 falls = max(of_map, 0.0) * plane_to_all / max(of_map_to_all * of_plane, vec3(1e-9));
    float whole = DISPLACED ? LEAST_VISIBLE * of_plane : of_plane;
    vec3 behind = max(whole - visible, 0.0) * falls * sent_to_all / visible_to_all;
    vec3 sum = (max(sent, 0.0) + behind) / max(visible, whole);
    return NEAR ? mix(sum, near + max(of_others, 0.0) / visible_to_all, drawn.near.share) : sum;
}

appearance fetch_appearance(surface_point surface) {
    lay_relief_on(surface);
    surface_point seen = surface;
    drawn.near.share = 0.0;
    if (NEAR && has_diffuse()) {
        find_near_facet(surface);
        seen = seen_surface(surface);
    }
    appearance fetched = fetch_averaged_appearance(surface, seen);
    if (EMISSIVE)
        fetched.emission = emission_of_relief(surface, fetched.emission);
    return fetched;
}

// ---------------------------------------------------------------------------------------------
// Of a footprint's light

void gather_relief(surface_point surface, bool lit) {
    drawn.viewer = viewer_of(surface);
    drawn.mirrored = vec3(0.0);
    drawn.mirrored_on = 0.0;
    fetch_transfer(transfer_area(NEAR ? seen_surface(surface) : surface));
    polynomials viewer = polynomials_of(drawn.viewer);
    float functions[ORDER];
    in_functions(viewer, functions);
    for (uint channel = 0u; channel < (COLOURED ? 3u : 1u); ++channel)
        drawn.colour[channel] =
            entry(first_entry(channel) + DIRECT_ENTRIES + TRANSFER_INDIRECT_COUNT);
    if (FACETS) {
        float area[ORDER];
        for (uint k = 0u; k < ORDER; ++k)
            area[k] = entry(TRANSFER_ENTRIES(ORDER) + k);
        drawn.visible = relative_area(visible_area(functions), viewer);
        drawn.area = in_polynomials(area);
        drawn.mean_area = polynomials(closure.visible);
        transfer_products(drawn.area.terms);
        transfer_products(drawn.mean_area.terms);
    }
    find_form(viewer, functions, lit);
}

// Of light between facets, by albedo: sums of powers, each less than the one before by the same
// factor. What the facet that the light meets first and the one that the viewer sees reflect are
// factors of their own.
vec3 indirect_share(vec3 albedo) {
    return (1.0 - closure.persistence) / (1.0 - albedo * closure.persistence);
}

// What reaches the viewer: of light at once, of light between facets, and of the latter where they
// mirror it to each other.
struct reflected_light {
    vec3 direct;
    vec3 indirect;
    vec3 sent_on;
};

// Of light whose channels have these products with the polynomials.
reflected_light reflect_channels(polynomials red, polynomials green, polynomials blue) {
    reflected_form form = drawn.form;
    if (!COLOURED)
        form.green = form.blue = form.red;
    return reflected_light(vec3(product(form.red.direct, red), product(form.green.direct, green),
                                product(form.blue.direct, blue)),
                           vec3(product(form.red.indirect, red),
                                product(form.green.indirect, green),
                                product(form.blue.indirect, blue)), vec3(0.0));
}

// Of a white sky, light between facets; of reliefs with colours, with these.
vec3 indirect_of_white_sky() {
    polynomials integrals = integrals_of_polynomials();
    float red = product(integrals, drawn.form.red.indirect);
    return COLOURED ? vec3(red, product(integrals, drawn.form.green.indirect),
                           product(integrals, drawn.form.blue.indirect))
                    : vec3(red);
}

// `over_lobe`: the mean of light over the lobe that smooth facets send on.
vec3 light_sent_on(vec3 indirect, vec3 over_lobe) {
    if (!FACETS)
        return indirect;
    return mix(indirect, max(indirect_of_white_sky(), vec3(0.0)) * over_lobe,
               drawn.sent_on.share);
}

reflected_light reflect_light(vec3 incoming) {
    polynomials light = polynomials_of(incoming);
    reflected_light reflected = reflect_channels(light, light, light);
    // Where facets are few and steep, the functions overshoot: without a bound by tens of times.
    reflected.direct = min(reflected.direct, vec3(INVERSE_PI));
    reflected.indirect = min(reflected.indirect, vec3(INVERSE_PI));
    reflected.sent_on =
        light_sent_on(reflected.indirect, vec3(density_of_sent_on(drawn.sent_on, incoming)));
    return reflected;
}

// What microfacets reflect of light from everywhere, at the mean cosine that a facet is seen under.
vec3 mirrored_part(base_material base) {
    const float MEAN_COSINE = 2.0 / 3.0;
    vec3 albedo = specular_albedo(albedo_of(MEAN_COSINE, base.width), base.specular, vec3(1.0)) *
                  scattering_scale(base.specular, MEAN_COSINE, base.width);
    return clamp(albedo, 0.0, 1.0);
}

// What counts as a diffuse colour where colours vary (facet_colours.comp), and what mirrors then
// above it: the rest of Schlick's Fresnel term has no colour of its own.
vec3 diffuse_colour_of(base_material base) {
    return MODEL == MODEL_MICROFACET ? base.diffuse * (1.0 - base.specular) : base.diffuse;
}

vec3 mirrored_above_diffuse(vec3 specular) {
    return COLOURED ? vec3(0.0) : specular;
}

// By how much the colours of what a pixel sees differ from those that are in the map of transfer:
// those of the vertices, and, where a pixel is smaller than its texels, of the material's maps.
vec3 tint_of(base_material base, surface_point surface) {
    vec3 colour = diffuse_colour_of(base);
    if (NEAR && drawn.near.share > 0.0)
        colour = mix(colour, diffuse_colour_of(drawn.near.base), drawn.near.share);
    vec3 tint = VERTEX_COLOUR ? surface.colour.rgb : vec3(1.0);
    if (!MAGNIFIED)
        return tint;
    float level = area_over(map_coordinates(MAP_HEIGHT, surface.coordinates, 1.0),
                            map_coordinates(MAP_HEIGHT, surface.coordinates_dx, 0.0),
                            map_coordinates(MAP_HEIGHT, surface.coordinates_dy, 0.0),
                            transfer_size(), true).level;
    vec3 found = (colour + 0.01) / (tint * drawn.colour + 0.01);
    return tint * mix(min(found, 4.0), vec3(1.0), min(level, 1.0));
}

// What two facets reflect of light between them: both diffusely, or one of them, or none.
vec3 between_facets(vec3 albedo, reflected_light reflected) {
    vec3 mirrored = drawn.mirrored;
    return albedo * (albedo + (1.0 + drawn.mirrored_on) * mirrored) * reflected.indirect +
           drawn.mirrored_on * mirrored * mirrored * reflected.sent_on;
}

// Where colours vary, light between facets has them already: as if all were diffuse, and metal
// mirrored as much as at right angles.
vec3 squared_colours(vec3 specular) {
    vec3 all = drawn.colour + specular;
    return max(all * all, vec3(1e-4));
}

// Radiance of diffuse facets. `passed`: the part of light that is not mirrored.
vec3 diffuse_radiance(base_material base, vec3 passed, surface_point surface,
                      reflected_light reflected) {
    vec3 sum;
    if (COLOURED) {
        vec3 tint = tint_of(base, surface), indirect = reflected.indirect;
        if (FACETS)
            indirect = between_facets(drawn.colour, reflected) / squared_colours(base.specular);
        sum = tint * (passed * reflected.direct + tint * indirect);
    } else {
        vec3 diffuse_colour = base.diffuse;
        if (NEAR && drawn.near.share > 0.0)
            diffuse_colour = mix(diffuse_colour, drawn.near.base.diffuse, drawn.near.share);
        vec3 albedo = clamp(diffuse_colour * passed, 0.0, 1.0);
        sum = albedo * reflected.direct + indirect_share(min(albedo + drawn.mirrored, 1.0)) *
                                              between_facets(albedo, reflected);
    }
    return max(sum, 0.0);
}

// ---------------------------------------------------------------------------------------------
// Microfacets of the facets

// The facets whose normals are in a bin, without their microfacets.
struct facet_group {
    float size;  // their area, over that of the carrier
    vec2 mean;   // of the places of their normals
    vec3 places; // their covariance
    // What the relief hides of them, and what it would if it hid as much of all, see relief.h.
    float hidden, expected;
};

facet_group facets_of_bin(surface_point surface, map_area area, uint index) {
    vec4 place = filtered_layer(facet_map, area, 2u * index);
    vec4 spread = filtered_layer(facet_map, area, 2u * index + 1u);
    float scale = 1.0 / max(place.x, 1e-6);
    vec2 mean = place.yz * scale;
    mat2 turn = transpose(turn_of_map());
    vec3 places = stretched_covariance(turn, covariance_of(mean, spread.xyz * scale));
    return facet_group(place.x, turn * (closure.basis.groups[2u * index].xy + mean),
                       places + surface.curvature, place.w, spread.w);
}

// The same of the whole map, where other facets are than a pixel's own.
facet_group facets_of_map(uint index) {
    vec4 group = closure.basis.groups[2u * index], inverse = closure.basis.groups[2u * index + 1u];
    mat2 turn = transpose(turn_of_map());
    vec3 places = stretched_covariance(turn, group_covariance(inverse));
    return facet_group(group.w, turn * group.xy, places, 0.0, 0.0);
}

normal_spread normals_of(facet_group facets) {
    return normal_spread_of(facets.mean, facets.places + second_moments_of(facets.mean));
}

// Of the facets' microfacets.
plane_bin bin_of(facet_group facets, float width) {
    plane_bin bin;
    // The lobes' own mass, microfacets' area.
    bin.mass = facets.size * plane_mass(MODEL, distribution_kind(), width);
    bin.mean = facets.mean;
    bin.axis = direction_from_plane(bin.mean);
    bin.variance = bin.mean_variance = plane_variance(distribution_kind(), width);
    bin.sharpness = inversesqrt(bin.variance);
    bin.places = facets.places;
    bin.spread = 0.5 * (bin.places.x + bin.places.y);
    vec3 base = bin.variance * plane_distortion(bin.mean);
    bin.covariance = bin.places + base;
    make_terms(bin, bin.places, base, vec2(bin.variance), 0.0);
    keep_shape(bin, vec2(bin.variance));
    return bin;
}

facet_spread spread_of(facet_group facets) {
    return facet_spread_of(normals_of(facets), facets.size);
}

// What faces a direction, hidden or not, as it appears from there.
float facing_area(facet_spread facets[FACET_BINS], vec3 direction) {
    float sum = 0.0;
    for (uint k = 0u; k < FACET_BINS; ++k)
        sum += facing_area(facets[k], direction);
    return sum;
}

// The area that is seen from a direction, and what faces it, both times the same number: the one by
// the facets' horizons, the other by their normals alone.
vec2 seen_and_facing(facet_spread facets[FACET_BINS], vec3 direction) {
    polynomials terms;
    transfer_terms(map_from_tangent(direction), terms.terms);
    float mean = max(product(drawn.mean_area, terms), 1e-6);
    float seen = direction.z * max(product(drawn.area, terms), LEAST_VISIBLE * mean);
    return vec2(seen, max(mean * facing_area(facets, direction), max(seen, 1e-6)));
}

// The part of what faces a direction that is also seen from there.
float seen_part(facet_spread facets[FACET_BINS], vec3 direction) {
    vec2 areas = seen_and_facing(facets, direction);
    return clamp(areas.x / areas.y, 0.0, 1.0);
}

// How much more the relief hides of something than of others: of Smith's Lambda. Both are of such
// an `area` of facets.
float odds_of_hiding(float area, float hidden, float expected) {
    float least = 1e-3 * area;
    return (hidden + least) * max(area - expected, 20.0 * least) /
           ((expected + least) * max(area - hidden, 20.0 * least));
}

vec3 hiding_of(facet_group group) {
    return vec3(group.size * product_of_cosines(1.0 - 0.5 * dot(group.mean, group.mean)),
                group.hidden, group.expected);
}

// Of each bin, its Lambda over that of all facets. Level facets at the bottom are hidden more than
// those on tops. Directions from which much is hidden count for little in the means that it is
// found from, so that these differ by less than Lambda does: by the power of 2/3 on seven reliefs.
// `all`: the bins of all widths, of which `groups` may be one's.
void find_depths(facet_group groups[FACET_BINS], facet_group all[FACET_BINS],
                 out float depths[FACET_BINS]) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        vec3 own = hiding_of(groups[k]);
        depths[k] = odds_of_hiding(own.x, own.y, own.z);
        sum += hiding_of(all[k]);
    }
    float scale = 1.0 / odds_of_hiding(sum.x, sum.y, sum.z);
    for (uint k = 0u; k < FACET_BINS; ++k)
        depths[k] = clamp(scale * depths[k] * sqrt(scale * depths[k]), 0.05, 8.0);
}

// Smith's Lambda, where so much of what faces a direction is seen.
float lambda_of_seen(float seen) {
    return 1.0 / max(seen, 1e-4) - 1.0;
}

// What is seen of a bin's facets of a depth, see find_depths(), where Lambda says how much of all
// is hidden. Of those higher than a part u of the relief u^Lambda is seen. Over all heights -log(u)
// falls exponentially, and the mean is 1 / (1 + Lambda). So it is taken to do in a bin, but of one
// of two widths heights are closer together: a Gamma distribution of shape 2.
float seen_at_depth(float depth, float lambda) {
    float sum = 1.0 + 0.5 * depth * lambda;
    return WIDTHS_SPLIT ? 1.0 / (sum * sum) : 1.0 / (1.0 + depth * lambda);
}

// What both directions see, if heights decide: Smith's masking with correlated heights, 1 / (1 +
// Lambda + Lambda'), written with 1 / (1 + Lambda) of both.
float seen_by_both(float first, float second) {
    return first * second / max(first + second - first * second, 1e-6);
}

// Second moments of the slopes of all facets: of their normals' places, which are about as large.
vec3 moments_of_slopes(facet_group groups[FACET_BINS]) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < FACET_BINS; ++k)
        sum += groups[k].size * (groups[k].places + second_moments_of(groups[k].mean));
    return sum;
}

// The height of directions from which on the relief hides no light that facets mirror to the
// viewer, on the side that their mean mirrors: found where the lobe is, but low enough that
// something is hidden, which of Gaussian slopes it is up to about their deviation.
// `deviation`: of the lobe's height. `slopes`: see moments_of_slopes().
float height_of_open_sky(facet_spread facets[FACET_BINS], vec3 slopes, vec3 mirrored,
                         float deviation) {
    const float LEAST_HEIGHT = 0.05, MOST_HEIGHT = 0.4, DEVIATIONS = 0.75;
    vec2 level = inversesqrt(max(dot(mirrored.xy, mirrored.xy), 1e-8)) * mirrored.xy;
    float most = clamp(DEVIATIONS * sqrt(max(covariance_along(slopes, level, level), 0.0)), 1e-3,
                       MOST_HEIGHT);
    positive_part above = positive_part_of(mirrored.z / deviation);
    float height = clamp(mirrored.z + deviation * above.shift, min(LEAST_HEIGHT, most), most);
    vec3 direction = vec3(sqrt(1.0 - height * height) * level, height);
    float open = seen_part(facets, direction);
    return height * drawn.seen / max(seen_by_both(drawn.seen, open), 0.02 * drawn.seen);
}

// The deviation of the height of directions that normals mirror.
float deviation_of_mirrored(normal_spread normals, vec3 viewer) {
    vec3 normal = normalize(normals.mean);
    vec3 across = direction_step(normals.place, vec2(1.0, 0.0)),
         up = direction_step(normals.place, vec2(0.0, 1.0));
    float cosine = dot(normal, viewer);
    vec2 gradient = 2.0 * (normal.z * vec2(dot(viewer, across), dot(viewer, up)) +
                           cosine * vec2(across.z, up.z));
    return sqrt(max(covariance_along(normals.covariance, gradient, gradient), 1e-6));
}

// What is seen of all facets from four directions that those of a bin mirror to the viewer, and
// what faces these: nodes of normals that are Gaussian in the plane (exact for polynomials of
// degree 3).
struct mirrored_sky {
    vec3 incoming[4];
    vec4 seen; // 0 below the carrier
    vec4 facing;
};

mirrored_sky sky_of_bin(facet_spread facets[FACET_BINS], normal_spread normals) {
    const vec2 NODES[4] = vec2[4](vec2(1.0, 1.0), vec2(-1.0, 1.0), vec2(1.0, -1.0),
                                  vec2(-1.0, -1.0));
    vec2 place = plane_from_direction(normalize(normals.mean));
    float x = sqrt(max(normals.covariance.x, 1e-12)), shear = normals.covariance.z / x;
    float y = sqrt(max(normals.covariance.y - shear * shear, 1e-12));
    mirrored_sky sky;
    for (uint i = 0u; i < 4u; ++i) {
        vec2 node = NODES[i];
        vec3 normal = direction_from_plane(place + vec2(x * node.x, shear * node.x + y * node.y));
        sky.incoming[i] = reflect(-drawn.viewer, normal);
        vec2 areas = seen_and_facing(facets, sky.incoming[i]);
        sky.seen[i] = sky.incoming[i].z > 0.0 ? areas.x : 0.0;
        sky.facing[i] = areas.y;
    }
    return sky;
}

// The parts of what the facets of a bin mirror to the viewer that come from above the relief, from
// each of the four directions, under an even sky: masked as a sun is, see seen_at_depth().
vec4 lit_parts(mirrored_sky sky, float depth) {
    float part = WIDTHS_SPLIT ? 0.5 * depth : depth;
    vec4 lit = (1.0 + part * lambda_of_seen(drawn.seen)) * sky.seen;
    lit /= lit + part * (sky.facing - sky.seen);
    return WIDTHS_SPLIT ? lit * lit : lit;
}

// Of each bin, the area that faces the viewer, as it appears from there, masked, and shadowed:
// smooth facets where they mirror light from, and rough ones as diffuse ones are; under an
// environment, whose lobes end at horizons as well, half as much.
struct mirroring_bins {
    facet_group groups[FACET_BINS];
    facet_spread facets[FACET_BINS]; // the same
    float depths[FACET_BINS]; // see find_depths()
    float seen[FACET_BINS];   // areas that are not masked
    mirrored_sky skies[FACET_BINS];
    float lit[FACET_BINS];    // the mean of lit_parts()
    float areas[FACET_BINS];  // shadowed as well, of one width of microfacets
    float shares[FACET_BINS];   // of the bin's facets, those that face the viewer
    float shown;                // the sum of areas
    vec3 sent_on;               // see lib/displacement/second_facets.glsl
    float hidden;               // of light that smooth facets mirror, what meets other facets
    float scale;                // of areas that are not masked, so that these are what is seen
    float part;                 // of one width's bins: what is seen of them, over that of all
};

// Where a pixel's own facets face away from the viewer, `others` are seen behind them: the map's.
// Adds so much of these that what is seen is not more than what faces the viewer.
void add_facets_seen_behind(inout facet_group groups[FACET_BINS], facet_group others[FACET_BINS],
                            facet_spread behind[FACET_BINS]) {
    facet_spread facets[FACET_BINS];
    for (uint k = 0u; k < FACET_BINS; ++k)
        facets[k] = spread_of(groups[k]);
    float lacking = drawn.viewer.z * drawn.visible - facing_area(facets, drawn.viewer);
    if (lacking <= 0.0)
        return;
    float scale = lacking / max(facing_area(behind, drawn.viewer), 1e-3);
    drawn.area = sum_of(drawn.area, 1.0, drawn.mean_area, scale);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        float size = groups[k].size + scale * others[k].size;
        float part = scale * others[k].size / max(size, 1e-6);
        vec2 apart = others[k].mean - groups[k].mean;
        groups[k].places = mix(groups[k].places, others[k].places, part) +
                           part * (1.0 - part) * second_moments_of(apart);
        groups[k].mean += part * apart;
        groups[k].hidden /= max(1.0 - part, 1e-3);
        groups[k].expected /= max(1.0 - part, 1e-3);
        groups[k].size = size;
    }
}

// What the rougher of two widths has of a bin.
struct rough_facets {
    float share;  // of the bin's facets
    vec2 apart;   // the mean place of its facets, less that of the others
    float hidden; // its part of what the relief hides of the bin
};

// A bin that is rougher than the mean of all has more of the rougher width than the pixel, in
// proportion: exact where there are no other widths. So have its place and what is hidden of it.
void find_rough_facets(surface_point surface, facet_group groups[FACET_BINS],
                       out rough_facets rough[FACET_BINS]) {
    map_area area = transfer_area(surface);
    mat2 turn = transpose(turn_of_map());
    vec4 own[FACET_BINS], widths[FACET_BINS];
    vec2 all = vec2(0.0);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        own[k] = filtered_layer(facet_map, area, 2u * k);
        widths[k] = filtered_layer(facet_map, area, 2u * FACET_BINS + k);
        all += vec2(own[k].x, widths[k].x);
    }
    float mean = all.y / max(all.x, 1e-6);
    float beyond = drawn.two.alpha.y - drawn.two.alpha.x;
    float scale = beyond > 1e-3 ? material.roughness * material.roughness / beyond : 0.0;
    for (uint k = 0u; k < FACET_BINS; ++k) {
        vec4 part = drawn.two.share.y * own[k] + scale * (widths[k] - mean * own[k]);
        float share = clamp(part.x / max(own[k].x, 1e-6), 0.0, 1.0);
        float both = share * (1.0 - share);
        rough[k].share = share;
        rough[k].hidden = own[k].w > 1e-6 ? clamp(part.w / own[k].w, 0.0, 1.0) : share;
        rough[k].apart = vec2(0.0);
        if (both < 1e-3)
            continue;
        // Both means are as far apart as the bin's own spread allows.
        const float MOST = 0.75;
        vec2 apart = turn * (part.yz - share * own[k].yz) / (max(own[k].x, 1e-6) * both);
        vec3 places = groups[k].places;
        float determinant = max(places.x * places.y - places.z * places.z, 1e-12);
        float square = both * (places.y * apart.x * apart.x + places.x * apart.y * apart.y -
                               2.0 * places.z * apart.x * apart.y) / determinant;
        rough[k].apart = apart * min(1.0, sqrt(MOST / max(square, 1e-6)));
    }
}

// A bin's facets of one width, as if all of the pixel had this.
facet_group facets_of_width(facet_group group, rough_facets rough, uint width) {
    float share = width == 0u ? 1.0 - rough.share : rough.share;
    float hidden = width == 0u ? 1.0 - rough.hidden : rough.hidden;
    float scale = 1.0 / max(drawn.two.share[width], 1e-3);
    group.mean += (width == 0u ? -rough.share : 1.0 - rough.share) * rough.apart;
    group.places -= rough.share * (1.0 - rough.share) * second_moments_of(rough.apart);
    group.size *= scale * share;
    group.hidden *= scale * hidden;
    group.expected *= scale * share;
    return group;
}

// All but the areas of one width.
mirroring_bins find_bins(surface_point surface) {
    map_area area = transfer_area(surface);
    mirroring_bins bins;
    facet_group others[FACET_BINS];
    facet_spread behind[FACET_BINS];
    for (uint k = 0u; k < FACET_BINS; ++k) {
        bins.groups[k] = facets_of_bin(surface, area, k);
        others[k] = facets_of_map(k);
        behind[k] = spread_of(others[k]);
    }
    add_facets_seen_behind(bins.groups, others, behind);
    for (uint k = 0u; k < FACET_BINS; ++k)
        bins.facets[k] = spread_of(bins.groups[k]);
    drawn.seen = seen_part(bins.facets, drawn.viewer);
    find_depths(bins.groups, bins.groups, bins.depths);
    float facing = 0.0, masked = 0.0, kept = 1e-6;
    bins.sent_on = vec3(0.0);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        float size = bins.groups[k].size;
        normal_spread normals = normals_of(bins.groups[k]);
        normal_spread seen = seen_normals(normals, drawn.viewer, bins.shares[k]);
        bins.seen[k] = 0.0;
        if (size * bins.shares[k] <= 1e-4)
            continue;
        float cosine = facing_area(bins.facets[k], drawn.viewer);
        bins.seen[k] = cosine * seen_at_depth(bins.depths[k], lambda_of_seen(drawn.seen));
        facing += cosine;
        masked += bins.seen[k];
        bins.skies[k] = sky_of_bin(bins.facets, seen);
        vec4 lit = lit_parts(bins.skies[k], bins.depths[k]);
        bins.lit[k] = dot(lit, vec4(0.25));
        light_moments hidden = no_moments();
        for (uint i = 0u; i < 4u; ++i)
            add_moments(hidden, 0.25 * (1.0 - lit[i]), map_from_tangent(bins.skies[k].incoming[i]));
        kept += bins.seen[k] * (1.0 - bins.lit[k]);
        bins.sent_on +=
            bins.seen[k] * directions_from_second(hidden, closure.basis.second, k);
    }
    bins.sent_on = tangent_from_map(bins.sent_on) / kept;
    bins.hidden = kept / max(masked, 1e-6);
    // Together they are what is seen.
    float scale = drawn.seen * facing / max(masked, 1e-6);
    bins.scale = scale;
    bins.part = 1.0;
    for (uint k = 0u; k < FACET_BINS; ++k)
        bins.seen[k] *= scale;
    return bins;
}

// The bins of one width. What hides them is all facets.
mirroring_bins bins_of_width(mirroring_bins all, rough_facets rough[FACET_BINS], uint width) {
    mirroring_bins bins = all;
    for (uint k = 0u; k < FACET_BINS; ++k)
        bins.groups[k] = facets_of_width(all.groups[k], rough[k], width);
    find_depths(bins.groups, all.groups, bins.depths);
    float own = 0.0, everything = 1e-6;
    for (uint k = 0u; k < FACET_BINS; ++k) {
        everything += all.seen[k];
        bins.seen[k] = 0.0;
        seen_normals(normals_of(bins.groups[k]), drawn.viewer, bins.shares[k]);
        // Of a bin that find_bins() left out, the sky is not known.
        if (all.seen[k] <= 0.0 || bins.groups[k].size * bins.shares[k] <= 1e-4)
            continue;
        bins.seen[k] = all.scale * facing_area(spread_of(bins.groups[k]), drawn.viewer) *
                       seen_at_depth(bins.depths[k], lambda_of_seen(drawn.seen));
        bins.lit[k] = dot(lit_parts(all.skies[k], bins.depths[k]), vec4(0.25));
        own += bins.seen[k];
    }
    bins.part = own / everything;
    return bins;
}

float lit_if_rough(bool of_environment) {
    return of_environment ? 0.5 + 0.5 * closure.direct : closure.direct;
}

void find_areas(inout mirroring_bins bins, float width, bool of_environment) {
    float roughness = roughness_from_parameter(DISTRIBUTION, width);
    bins.shown = 0.0;
    for (uint k = 0u; k < FACET_BINS; ++k) {
        bins.areas[k] = 0.0;
        if (bins.seen[k] > 0.0)
            bins.areas[k] = bins.seen[k] * mix(bins.lit[k], lit_if_rough(of_environment),
                                               roughness * roughness);
        bins.shown += bins.areas[k];
    }
}

// Of each bin, the height from which on the relief hides no light.
void find_horizons(mirroring_bins bins, float width, out float horizons[FACET_BINS]) {
    vec3 slopes = moments_of_slopes(bins.groups);
    float roughness = roughness_from_parameter(DISTRIBUTION, width);
    for (uint k = 0u; k < FACET_BINS; ++k) {
        float share;
        normal_spread seen = seen_normals(normals_of(bins.groups[k]), drawn.viewer, share);
        vec3 mirrored = reflect(-drawn.viewer, normalize(seen.mean));
        float top = height_of_open_sky(bins.facets, slopes, mirrored,
                                       deviation_of_mirrored(seen, drawn.viewer));
        horizons[k] = max(top * (1.0 - roughness * roughness), 1e-3);
    }
}

// The widths of what is mirrored.
void find_widths(appearance fetched, surface_point surface) {
    drawn.widths[0] = fetched.base.width;
    drawn.shares[0] = 1.0;
    if (WIDTHS == 1u)
        return;
    two_widths found = find_two_widths(base_lobe_concentration(DISTRIBUTION, fetched.base.width),
                                       fetch_alpha_moments(lobe_area(surface), surface));
    drawn.two = found;
    for (uint i = 0u; i < WIDTHS; ++i) {
        drawn.widths[i] = base_lobe_of_concentration(DISTRIBUTION,
                                                     2.0 / (found.alpha[i] * found.alpha[i]));
        drawn.shares[i] = found.share[i];
    }
}

// Light that rough facets mirror onto others goes on as if it were diffuse, and that of smooth ones
// as in light_sent_on.glsl. It is as much as the bins do not show of what is above the relief, so
// that none is lost: relative to diffuse light, of which a white relief sends on what it does not
// reflect at once. Adds what one width has of it.
void add_mirrored_on(base_material base, mirroring_bins bins, float share) {
    float kept = max(bins.part - bins.shown / (drawn.viewer.z * drawn.visible), 0.0);
    vec3 one = vec3(1.0), colours = COLOURED ? squared_colours(base.specular) : one;
    float diffuse = dot(indirect_of_white_sky(), one) / dot(colours, one);
    drawn.mirrored += share * mirrored_part(base);
    drawn.mirrored_on +=
        share * min(kept / max(diffuse, LEAST_INDIRECT), MOST_MIRRORED_ON);
}

void find_axis_of_sent_on(mirroring_bins bins, bool of_environment) {
    float roughness = 0.0;
    for (uint i = 0u; i < WIDTHS; ++i)
        roughness += drawn.shares[i] * roughness_from_parameter(DISTRIBUTION, drawn.widths[i]);
    vec3 slopes = moments_of_slopes(bins.groups);
    // Of what meets other facets, all but what is mirrored as if it were diffuse, see find_areas().
    float rough = roughness * roughness, share = (1.0 - rough) * bins.hidden;
    share /= max(share + rough * (1.0 - lit_if_rough(of_environment)), 1e-6);
    drawn.sent_on =
        find_sent_on(bins.sent_on, sqrt(0.5 * (slopes.x + slopes.y)), roughness, share);
}

void gather_facets(appearance fetched, surface_point surface, vec3 incoming[4]) {
    find_widths(fetched, surface);
    mirroring_bins bins = find_bins(surface);
    find_axis_of_sent_on(bins, false);
    float hiding[4]; // Lambda of light and viewer
    for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i)
        hiding[i] = lambda_of_seen(drawn.seen) +
                    lambda_of_seen(seen_part(bins.facets, incoming[i]));
    mirroring_bins all = bins;
    rough_facets rough[FACET_BINS];
    if (WIDTHS_SPLIT)
        find_rough_facets(surface, bins.groups, rough);
    for (uint w = 0u; w < WIDTHS; ++w) {
        if (WIDTHS_SPLIT)
            bins = bins_of_width(all, rough, w);
        base_material base = fetched.base;
        base.width = drawn.widths[w];
        find_areas(bins, base.width, false);
        add_mirrored_on(base, bins, drawn.shares[w]);
        for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i)
            drawn.lights[4u * w + i] = no_light();
        for (uint k = 0u; k < FACET_BINS; ++k) {
            if (bins.groups[k].size <= 1e-4)
                continue;
            plane_bin bin = bin_of(bins.groups[k], base.width);
            for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i) {
                add_seen_bin(drawn.lights[4u * w + i], bin,
                             half_vector(incoming[i], surface.outgoing), surface.outgoing,
                             incoming[i], seen_at_depth(bins.depths[k], hiding[i]));
            }
        }
    }
}

// Over the area that the viewer sees.
vec3 mirrored_by_facets(base_material base, vec3 fresnel, uint light) {
    vec3 sum = vec3(0.0);
    for (uint w = 0u; w < WIDTHS; ++w) {
        base.width = drawn.widths[w];
        sum += drawn.shares[w] * mirrored_light(base, drawn.lights[4u * w + light], fresnel);
    }
    return sum / (drawn.viewer.z * drawn.visible);
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
    vec3 lobes, above_diffuse = vec3(0.0);
    if (FACETS) {
        float cosine = dot(incoming, half_vector(incoming, surface.outgoing));
        vec3 fresnel = fresnel_schlick(base.specular, vec3(1.0), cosine);
        above_diffuse = fresnel_schlick(mirrored_above_diffuse(base.specular), vec3(1.0), cosine);
        lobes = mirrored_by_facets(fetched.base, fresnel, light);
    } else {
        base_material mirroring = base;
        mirroring.diffuse = vec3(0.0);
        lobes = evaluate_base_material(mirroring, fetched.mean_normal, surface.outgoing, incoming);
    }
    vec3 of_cells = diffuse_radiance(base, 1.0 - above_diffuse, surface, reflect_light(incoming));
    if (!NEAR || drawn.near.share == 0.0)
        return lobes + of_cells;
    return (1.0 - drawn.near.share) * lobes + of_cells +
           drawn.near.share * reflected_by_near_facet(surface.outgoing, incoming);
}

#ifdef ENVIRONMENT
// The environment's integrals with the polynomials, of each channel.
void light_of_environment(surface_point surface, out polynomials light[3]) {
    mat3 tangent_from_environment = tangent_from_environment_of(surface);
    hemisphere_moments moments = hemisphere_moments_about(
        hemisphere_moments_map, transpose(tangent_from_environment)[2]);
    mat3 map_from_environment = mat3(map_from_tangent(tangent_from_environment[0]),
                                     map_from_tangent(tangent_from_environment[1]),
                                     map_from_tangent(tangent_from_environment[2]));
    float red[16], green[16], blue[16];
    transfer_polynomials_of_light(moments.red, map_from_environment, red);
    transfer_polynomials_of_light(moments.green, map_from_environment, green);
    transfer_polynomials_of_light(moments.blue, map_from_environment, blue);
    light = polynomials[3](scaled(polynomials_from(red), environment.intensity),
                           scaled(polynomials_from(green), environment.intensity),
                           scaled(polynomials_from(blue), environment.intensity));
}

// A white facet reflects no more than the light of the whole hemisphere over pi, nor gets more from
// others. Both parts overshoot, against each other in a white furnace: only their sum is bounded.
// The light is that of the integrals' own sum, which lacks what is close to the horizon.
vec3 most_of_environment(polynomials light[3]) {
    polynomials integrals = integrals_of_polynomials();
    return 2.0 * INVERSE_PI *
           max(vec3(product(light[0], integrals), product(light[1], integrals),
                    product(light[2], integrals)),
               0.0);
}

// Of one width of microfacets.
vec3 reflect_bins_of_relief(base_material base, surface_point surface, mirroring_bins bins) {
    float horizons[FACET_BINS];
    find_horizons(bins, base.width, horizons);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < FACET_BINS; ++k)
        if (bins.areas[k] > 0.0)
            sum += bins.areas[k] / max(bins.shares[k], 1e-3) *
                   reflect_bin(surface, bin_of(bins.groups[k], base.width), base.specular,
                               facet_view(true, true, horizons[k]));
    return sum;
}

vec3 reflect_facets_of_relief(appearance fetched, surface_point surface) {
    find_widths(fetched, surface);
    mirroring_bins bins = find_bins(surface);
    find_axis_of_sent_on(bins, true);
    mirroring_bins all = bins;
    rough_facets rough[FACET_BINS];
    if (WIDTHS_SPLIT)
        find_rough_facets(surface, bins.groups, rough);
    vec3 sum = vec3(0.0);
    for (uint w = 0u; w < WIDTHS; ++w) {
        if (WIDTHS_SPLIT)
            bins = bins_of_width(all, rough, w);
        base_material base = fetched.base;
        base.width = drawn.widths[w];
        find_areas(bins, base.width, true);
        add_mirrored_on(base, bins, drawn.shares[w]);
        sum += drawn.shares[w] * reflect_bins_of_relief(base, surface, bins);
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
    white.specular = mirrored_above_diffuse(base.specular);
    polynomials light[3];
    light_of_environment(surface, light);
    gather_relief(surface, true);
    reflected_light reflected = reflect_channels(light[0], light[1], light[2]);
    vec3 lobes = FACETS ? reflect_facets_of_relief(fetched, surface)
                        : reflect_base_specular(surface, base);
    if (FACETS)
        reflected.sent_on = light_sent_on(
            reflected.indirect, environment.intensity * round_radiance(surface, DISTRIBUTION_VMF,
                                                               drawn.sent_on.mean_axis,
                                                               drawn.sent_on.mean_concentration));
    if (NEAR && drawn.near.share > 0.0)
        lobes = mix(lobes, mirrored_by_near_facet(surface), drawn.near.share);
    vec3 diffuse = diffuse_radiance(base, let_through(surface, white), surface, reflected);
    return lobes + min(diffuse, most_of_environment(light));
}
#endif
