#ifndef TEXELS_SEEN_GLSL
#define TEXELS_SEEN_GLSL

// Where bins of neighbouring texels differ, those of the texels that a trilinear sampler would
// blend are evaluated one by one, weighted as it weights the texels. See
// filters/mixture/likeness.comp.

#include "shading/filtered_maps.glsl"
#include "interface/moment_bins.h"
#include "lib/map/bilinear_texel.glsl"

layout(constant_id = SPECIALISE_SINGLE_TEXELS) const uint SINGLE_TEXELS = SINGLE_TEXELS_NEVER;

layout(LOBE_DESCRIPTOR(16)) uniform sampler2DArray moment_map;
// Samplers of these two return single texels.
layout(LOBE_DESCRIPTOR(52)) uniform sampler2DArray likeness_map;
layout(LOBE_DESCRIPTOR(53)) uniform sampler2DArray moment_texels; // moment_map again

// What is evaluated for a probe: the blend of all of a trilinear sampler's texels, or for each of
// two levels the blend of four texels or each of these.
struct texels_seen {
    bool blended;
    uint finer, coarser; // of each level: 1 or 4
    float level;         // of the map; the fraction is the coarser level's part
    uint count;          // for all probes
};

// See mixture_likeness_constants: of the largest over all probes.
float unlikeness(map_area area, float level) {
    float most = 0.0;
    vec2 size = size_of_level(textureSize(moment_map, 0).xy, level);
    for (uint i = 0u; i < probes_of(area); ++i) {
        vec2 position = (first_bilinear_texel(probe_position(area, i), size) + 0.5) / size;
        most = max(most, textureLod(likeness_map, vec3(position, 0.0), level).x);
    }
    return most;
}

texels_seen find_texels(map_area area) {
    texels_seen seen = texels_seen(true, 1u, 1u, 0.0, 1u);
    if (SINGLE_TEXELS == SINGLE_TEXELS_NEVER)
        return seen;
    float last = float(textureQueryLevels(moment_map) - 1);
    seen.level = clamp(fetched_level(area), 0.0, last);
    seen.finer = seen.coarser = 4u;
    if (SINGLE_TEXELS == SINGLE_TEXELS_UNLIKE) {
        float level = floor(seen.level);
        float finer = unlikeness(area, level), coarser = unlikeness(area, min(level + 1.0, last));
        seen.blended = max(finer, coarser) < 0.75 && (finer < 0.25 || fract(seen.level) == 0.0);
        if (seen.blended)
            return seen;
        seen.finer = finer < 0.75 ? 1u : 4u;
        seen.coarser = coarser < 0.75 ? 1u : 4u;
    }
    seen.blended = false;
    seen.count = probes_of(area) * (seen.finer + seen.coarser);
    return seen;
}

// What fetches number `index` of these alone; `weight`: its part of the pixel.
map_area area_of_texel(map_area area, texels_seen seen, uint index, out float weight) {
    weight = 1.0;
    if (SINGLE_TEXELS == SINGLE_TEXELS_NEVER || seen.blended)
        return area;
    uint of_probe = seen.finer + seen.coarser, probe = index / of_probe, own = index % of_probe;
    bool is_coarser = own >= seen.finer;
    if (is_coarser)
        own -= seen.finer;
    float coarser = fract(seen.level);
    weight = (is_coarser ? coarser : 1.0 - coarser) / float(probes_of(area));
    map_area texel = area;
    float level = floor(seen.level) + (is_coarser ? 1.0 : 0.0);
    texel.level = level + 1.0;
    texel.centre = probe_position(area, probe);
    texel.probes = 1u;
    if ((is_coarser ? seen.coarser : seen.finer) == 1u)
        return texel;
    vec2 size = size_of_level(textureSize(moment_map, 0).xy, level);
    bilinear_texel one = find_bilinear_texel(texel.centre, size, own);
    weight *= one.weight;
    texel.centre = one.position;
    return texel;
}

// The mean of one layer of moment_map over what is fetched. Where every fetch is of a single texel,
// a sampler that does not blend is faster. Where only some are, lavapipe would compute both; and at
// a texel's centre, a blend is that texel.
vec4 moment_layer(map_area texels, uint layer) {
    if (SINGLE_TEXELS == SINGLE_TEXELS_ALWAYS)
        return textureLod(moment_texels, vec3(texels.centre, layer), texels.level - 1.0);
    return filtered_layer(moment_map, texels, layer);
}

#endif
