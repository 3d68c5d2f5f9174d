#ifndef LOBE_CLUSTERING_GLSL
#define LOBE_CLUSTERING_GLSL

// Characteristic vectors of base lobes, summed by cluster.
//
// Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, sections 3.2 and 4. Each cluster j of a
// subdivision keeps w_j r_j and, as a fourth channel, w_j: only these can be averaged further.
// Texels that are left out (outside the atlas, facing away, cut away by a mask) add nothing to
// either, so that the weights of a subdivision add up to the coverage; or, where texels count by
// what they mirror, to that, and the coverage is a sum of its own.

#include "maps/base_maps.glsl"
#include "maps/mirrored_luminance.glsl"
#include "interface/mixture.h"
#include "maps/colour_square.glsl"
#include "lib/lobe/half_vector_lobe.glsl"
#include "lib/lobe/lobe_cluster.glsl"
#include "lib/lobe/von_mises_fisher.glsl"
#include "lib/lobe/width_pair.glsl"

layout(constant_id = SPECIALISE_SUBDIVISION) const uint SUBDIVISION = 2;
layout(constant_id = SPECIALISE_MEAN_LAYER) const uint MEAN_LAYER = 0;
layout(constant_id = SPECIALISE_WEIGHTED) const bool WEIGHTED = false;
layout(constant_id = SPECIALISE_KEPT_LAYER) const uint KEPT_LAYER = 0;
layout(constant_id = SPECIALISE_WIDTH_LAYER) const uint WIDTH_LAYER = 0;
layout(constant_id = SPECIALISE_WIDTH_COLOURS) const bool WIDTH_COLOURS = false;
layout(constant_id = SPECIALISE_CLUSTERS) const uint CLUSTERS = CLUSTERS_TURNED;

layout(set = 0, binding = 16) uniform writeonly image2DArray mixture_map;

struct cluster_sums {
    vec4 halves[8]; // finest clusters; only the first where SUBDIVISION is 0
    vec4 mean;      // normal, and 1 - |r| of the base lobes
    float kept;     // coverage
    vec4 widths;    // of the base lobes; the last over texels
    vec4 complements[2]; // of those in each of the finest clusters
    vec4 colours;   // see interface/mixture.h
};

cluster_sums no_lobes() {
    cluster_sums sums;
    for (int i = 0; i < 8; ++i)
        sums.halves[i] = vec4(0.0);
    sums.mean = vec4(0.0);
    sums.kept = 0.0;
    sums.widths = vec4(0.0);
    sums.complements[0] = sums.complements[1] = vec4(0.0);
    sums.colours = vec4(0.0);
    return sums;
}

// `complement` is 1 - |r| of the lobe, `weight` its share of the target texel.
void add_lobe(inout cluster_sums sums, vec3 axis, float complement, float weight) {
    vec4 moment = weight * vec4((1.0 - complement) * axis, 1.0);
    if (SUBDIVISION == 0u) {
        sums.halves[0] += moment;
    } else {
        uint cluster = cluster_of(axis, CLUSTERS);
        for (uint i = 0u; i < 8u; ++i)
            sums.halves[i] += i == cluster ? moment : vec4(0.0);
        if (WIDTH_LAYER != 0u)
            sums.complements[cluster / 4u][cluster % 4u] += weight * complement;
    }
    sums.mean.w += weight * complement;
    if (WIDTH_LAYER != 0u)
        sums.widths.xyz += weight * width_powers(complement);
}

// 1 - |r| of each base lobe. If widths do not vary, it is constant over the dispatch, and the
// caller hoists it out of its loop over texels.
void base_complements(float width, out float complements[MATERIAL_MAXIMUM_LOBES]) {
    for (int i = 0; i < LOBE_COUNT; ++i)
        complements[i] = mean_resultant_complement(base_concentration(i, width));
}

// `to_mixture`: from the tangent frame to the space of the mixtures; `mask`: its factor of alpha
// and its cutoff.
void add_point(inout cluster_sums sums, target_point target, mat3 to_mixture, vec2 mask,
               inout float complements[MATERIAL_MAXIMUM_LOBES]) {
    vec2 point = target.place;
    float weight = target.weight * weight_of_point(point, mask.x, mask.y);
    vec3 normal = normal_at(point, mask.x, mask.y);
    if (has_map(MAP_WIDTH))
        base_complements(width_at(point), complements);
    sums.mean.xyz += weight * (to_mixture * normal);
    sums.kept += weight;
    if (WEIGHTED) {
        vec3 mirrored = mirrored_colour(point, has_map(MAP_BASE_COLOUR)
                                                   ? base_colour_at(target).rgb
                                                   : vec3(1.0));
        float luminance = lobe_luminance(mirrored);
        if (WIDTH_COLOURS) {
            vec2 chroma = mirrored.rb - luminance;
            float u = width_powers(complements[0]).x;
            sums.colours += weight * vec4(chroma, u * chroma);
            sums.widths.w += weight * u;
        }
        weight *= luminance;
    }
    for (int i = 0; i < LOBE_COUNT; ++i) {
        vec3 axis = MODEL == MODEL_MICROFACET
                        ? normal
                        : rotate_from_pole(normal, material.lobe_direction[i].xyz);
        float share = MODEL == MODEL_MICROFACET ? 1.0 : material.lobe_colour[i].w;
        add_lobe(sums, to_mixture * axis, complements[i], weight * share);
    }
}

void store_layer(ivec2 position, int layer, vec4 value) {
    imageStore(mixture_map, ivec3(position, layer), value);
}

void store_widths(ivec2 position, cluster_sums sums) {
    store_layer(position, int(WIDTH_LAYER), sums.widths);
    vec4 first = sums.complements[0], second = sums.complements[1];
    if (SUBDIVISION == 1u)
        first = vec4(first.xz + first.yw, second.xz + second.yw);
    if (SUBDIVISION >= 1u)
        store_layer(position, int(WIDTH_LAYER) + 1, first);
    if (SUBDIVISION >= 2u)
        store_layer(position, int(WIDTH_LAYER) + 2, second);
    if (WIDTH_COLOURS)
        store_layer(position, int(WIDTH_LAYER + 1u + SUBDIVISION), sums.colours);
}

void store_clusters(ivec2 position, cluster_sums sums) {
    if (SUBDIVISION == 0u) {
        store_layer(position, MIXTURE_LAYER_ONE, sums.halves[0]);
    } else {
        vec4 one = vec4(0.0);
        for (int i = 0; i < 4; ++i) {
            vec4 sector = sums.halves[2 * i] + sums.halves[2 * i + 1];
            one += sector;
            store_layer(position, MIXTURE_LAYER_SECTORS + i, sector);
            if (SUBDIVISION >= 2u) {
                store_layer(position, MIXTURE_LAYER_HALVES + 2 * i, sums.halves[2 * i]);
                store_layer(position, MIXTURE_LAYER_HALVES + 2 * i + 1, sums.halves[2 * i + 1]);
            }
        }
        store_layer(position, MIXTURE_LAYER_ONE, one);
    }
    if (MEAN_LAYER != 0u)
        store_layer(position, int(MEAN_LAYER), sums.mean);
    if (KEPT_LAYER != 0u)
        store_layer(position, int(KEPT_LAYER), vec4(sums.kept));
    if (WIDTH_LAYER != 0u)
        store_widths(position, sums);
}

#endif
