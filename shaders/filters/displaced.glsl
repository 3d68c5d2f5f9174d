// The diffuse light of a material's relief, with its shadows and the light between its facets, from
// a map of transfer (interface/displacement/relief.h): radiance is a form of two directions, whose
// coefficients are means over facets and may be averaged like colours. After Wu, Zhao, Yan,
// Ramamoorthi, 2019, Accurate Appearance Preserving Prefiltering for Rendering Displacement-Mapped
// Surfaces, whose scaling functions it replaces.
//
// Lobes, and materials without a relief, are shaded as by `toksvig`.

#include "shading/averaged_maps.glsl"
#include "interface/displacement/relief.h"
#include "lib/displacement/transfer_basis.glsl"
#include "lib/light/cube_texel.glsl"

layout(constant_id = SPECIALISE_RELIEF) const bool RELIEF = false;
layout(constant_id = SPECIALISE_TRANSFER_ORDER) const uint ORDER = 9;

layout(LOBE_DESCRIPTOR(33)) uniform sampler2DArray transfer_map;
layout(LOBE_DESCRIPTOR(34), std430) readonly buffer closure_block {
    transfer_closure_constants closure;
};

// Radiance towards a viewer nearer to the horizon than this is that of a viewer there.
const float LEAST_HEIGHT = 0.02;

// Light towards the viewer, for each function of the light's direction: a white relief's at once,
// and what it gets from other facets as well.
struct transfer_to_viewer {
    float direct[9];
    float indirect[9];
    float visible; // the area that the viewer sees, over the map's mean of it
};

// Where less is seen, radiance is that of light on so much.
const float LEAST_VISIBLE = 0.05;

base_material widened_material(appearance fetched) {
    base_material base = fetched.base;
    if (FILTERED_LOBES)
        base.variance += variance_of_mean_normal(length(fetched.mean_normal));
    return base;
}

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
            transfer.visible += entries[i] * outgoing[place - VISIBLE_ENTRIES];
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

transfer_to_viewer fetch_transfer(surface_point surface, vec3 viewer) {
    transfer_to_viewer transfer;
    float outgoing[9];
    transfer_functions(viewer, outgoing);
    for (uint k = 0u; k < 9u; ++k)
        transfer.direct[k] = transfer.indirect[k] = 0.0;
    transfer.visible = 0.0;
    map_area area = transfer_area(surface);
    uint row = 0u, column = 0u;
    for (uint layer = 0u; 4u * layer < VISIBLE_ENTRIES + ORDER; ++layer)
        add_entries(transfer, outgoing, filtered_layer(transfer_map, area, layer), layer, row,
                    column);
    add_closure(transfer, outgoing);
    float mean = 0.0;
    for (uint k = 0u; k < ORDER; ++k)
        mean += closure.visible[k / 4u][k % 4u] * outgoing[k];
    transfer.visible = max(transfer.visible / max(mean, 1e-6), LEAST_VISIBLE);
    return transfer;
}

// Of light between facets, by albedo: sums of powers, each less than the one before by the same
// factor.
vec3 indirect_share(vec3 albedo) {
    return albedo * albedo * (1.0 - closure.persistence) / (1.0 - albedo * closure.persistence);
}

vec3 viewer_of(surface_point surface) {
    vec3 viewer = surface.outgoing;
    viewer.z = max(viewer.z, LEAST_HEIGHT);
    return normalize(viewer);
}

// Radiance of diffuse facets, for light with these coefficients of the functions.
vec3 diffuse_radiance(surface_point surface, vec3 albedo, float light[9]) {
    vec3 viewer = viewer_of(surface);
    transfer_to_viewer transfer = fetch_transfer(surface, viewer);
    float direct = 0.0, indirect = 0.0;
    for (uint k = 0u; k < 9u; ++k) {
        direct += transfer.direct[k] * light[k];
        indirect += transfer.indirect[k] * light[k];
    }
    albedo = clamp(albedo, 0.0, 1.0);
    return max(albedo * direct + indirect_share(albedo) * indirect, 0.0) /
           (viewer.z * transfer.visible);
}

bool has_diffuse() {
    return RELIEF && (MODEL == MODEL_MICROFACET || DIFFUSE);
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
    float functions[9];
    transfer_functions(incoming, functions);
    return lobes + diffuse_radiance(surface, albedo * passed, functions);
}

#ifdef ENVIRONMENT
// The environment's coefficients, of each channel: sums over the texels of a coarse level. What
// these sums are off for light that is the same everywhere is added with the mean radiance.
const int LIGHT_WIDTH = 8;

void light_of_environment(surface_point surface, out float light[3][9]) {
    mat3 tangent_from_environment = transpose(mat3(to_environment(surface, vec3(1.0, 0.0, 0.0)),
                                                   to_environment(surface, vec3(0.0, 1.0, 0.0)),
                                                   to_environment(surface, vec3(0.0, 0.0, 1.0))));
    int level = max(findMSB(textureSize(environment_faces, 0).x / LIGHT_WIDTH), 0);
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

vec3 reflect_environment(appearance fetched, surface_point surface) {
    base_material base = widened_material(fetched);
    if (!has_diffuse())
        return reflect_base_material(surface, base, fetched.mean_normal);
    vec3 albedo = let_through(surface, base);
    base.diffuse = vec3(0.0);
    float light[3][9];
    light_of_environment(surface, light);
    vec3 sum = reflect_base_specular(surface, base);
    for (int channel = 0; channel < 3; ++channel)
        sum[channel] += diffuse_radiance(surface, albedo, light[channel])[channel];
    return sum;
}
#endif
