#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants SEEN_TILES

// The finest level of a map of lobe moments: every base lobe of the texels under a target texel
// adds its mass, place, second moments of the place, sharpness and variance in the Lambert plane to
// the bins that it belongs to. All of these are sums, so that filtering the map linearly filters
// the lobes. In bins with colours, all but the mass count by what the lobe mirrors. The texels' own
// lobes are level 0; the map starts where texels are averaged.
//
// With SEEN_TILES, only the tiles that are listed, of any level: its texels are then made from as
// many points of the base maps as the knob `texel_samples` says.

#include "maps/plane_lobes.glsl"
#include "lib/lobe/bin_membership.glsl"
#include "filters/moments/mirrored.glsl"
#include "maps/colour_square.glsl"
#include "lib/number/hash.glsl"
#include "maps/target_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BINS) const uint BINS = 1;
layout(constant_id = SPECIALISE_PARTITION) const uint PARTITION = PARTITION_FITTED;
layout(constant_id = SPECIALISE_BIN_COLOUR) const bool BIN_COLOUR = false;

// Along each axis of a texel; 0: all texels that it covers, which are those of a finest level.
layout(constant_id = SPECIALISE_TEXEL_SAMPLES) const uint TEXEL_SAMPLES = 0;

layout(set = 0, binding = 16) uniform writeonly image2DArray moment_map;
layout(set = 0, binding = 17, std140) uniform binning_block { moment_binning_constants binning; };

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

struct bin_sums {
    vec4 place[MOMENT_MAXIMUM_BINS];  // m, l p, l g; l: m, or in bins with colours what it mirrors
    vec4 spread[MOMENT_MAXIMUM_BINS]; // l p p, l v
    vec4 colour[MOMENT_MAXIMUM_BINS];
    vec4 diffuse; // and how much all count
};

float colour_unit() {
    return binning.largest.y * material.largest_colour;
}

// Those that lobes are shared among.
moment_bin current_bins[MOMENT_MAXIMUM_BINS];

void share_fitted(plane_lobe lobe, out float members[MOMENT_MAXIMUM_BINS]) {
    float most = -1e30;
    for (int i = 0; i < BINS; ++i) {
        members[i] = bin_likelihood(current_bins[i], lobe.place, lobe.variance);
        most = max(most, members[i]);
    }
    float sum = 0.0;
    for (int i = 0; i < BINS; ++i) {
        members[i] = exp(members[i] - most);
        sum += members[i];
    }
    for (int i = 0; i < BINS; ++i)
        members[i] /= sum;
}

// Bin 0 gets rough lobes; the others share the rest by direction.
void share_hats(plane_lobe lobe, out float members[MOMENT_MAXIMUM_BINS]) {
    bool rough = lobe.variance >= binning.hats.w;
    vec2 d = lobe.place - binning.hats.xy;
    float middle = PARTITION == PARTITION_CAP ? cap(d, binning.hats.z) : 0.0;
    for (int i = 0; i < 4; ++i)
        members[i + 1] = rough ? 0.0 : (1.0 - middle) * quarter(i, d, binning.hats.z);
    members[0] = rough ? 1.0 : 0.0;
    members[5] = rough ? 0.0 : middle;
}

void add_lobe(inout bin_sums sums, plane_lobe lobe, float weight) {
    float members[MOMENT_MAXIMUM_BINS];
    float mirrored = BIN_COLOUR ? mirrored_by(lobe.colour, colour_unit()) : 1.0;
    if (PARTITION == PARTITION_FITTED)
        share_fitted(lobe, members);
    else
        share_hats(lobe, members);
    for (int i = 0; i < BINS; ++i) {
        vec4 range = binning.bins[i].range;
        vec2 p = (lobe.place - range.xy) / range.z;
        float mass = members[i] * weight * lobe.mass / binning.largest.x;
        sums.place[i] += mass * vec4(1.0, mirrored * vec3(p, inversesqrt(lobe.variance) / range.w));
        sums.spread[i] += mass * mirrored *
                          vec4(p * p, p.x * p.y, lobe.variance / binning.bins[i].shape.w);
        if (BIN_COLOUR)
            sums.colour[i] += mass * lobe.colour;
    }
}

// `base_colour`: of the map at the point.
void add_point(inout bin_sums sums, vec2 point, vec3 base_colour, float weight) {
    weight *= weight_of_point(point, constants.alpha, constants.cutoff);
    vec3 normal = normal_at(point, constants.alpha, constants.cutoff);
    float factor = width_at(point);
    vec4 specular = vec4(0.0);
    vec3 diffuse = vec3(0.0);
    if (BIN_COLOUR) {
        colours_at(point, base_colour, specular, diffuse);
        specular.rgb /= colour_unit();
    }
    sums.diffuse += weight * vec4(diffuse / colour_unit(), 1.0);
    for (int i = 0; i < LOBE_COUNT; ++i)
        add_lobe(sums, make_lobe(i, normal, factor, specular), weight);
}

void add_all_texels(inout bin_sums sums, ivec2 position, float part) {
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    bool coloured = BIN_COLOUR && has_map(MAP_BASE_COLOUR);
    if (coloured)
        read_colours(points);
    for (int i = 0; i < count_of(points); ++i) {
        target_point point = point_of(points, i);
        add_point(sums, point.place, coloured ? base_colour_at(point).rgb : vec3(1.0),
                  part * point.weight);
    }
}

#ifdef SEEN_TILES
// One point in each square of a grid, at random: a regular grid would miss what repeats with it.
void add_samples(inout bin_sums sums, ivec2 position, ivec2 extent, float part) {
    uint seed = hash(uint(position.x) + hash(uint(position.y) + hash(constants.level)));
    for (uint y = 0u; y < TEXEL_SAMPLES; ++y) {
        for (uint x = 0u; x < TEXEL_SAMPLES; ++x) {
            uint number = seed + 2u * (y * TEXEL_SAMPLES + x);
            vec2 place = vec2(x, y) + vec2(hashed_number(number), hashed_number(number + 1u));
            vec2 point = (vec2(position) + place / float(TEXEL_SAMPLES)) / vec2(extent);
            add_point(sums, point, value_at(MAP_BASE_COLOUR, base_colour_map, point).rgb,
                      part / float(TEXEL_SAMPLES * TEXEL_SAMPLES));
        }
    }
}
#endif

void add_points(inout bin_sums sums, ivec2 position, ivec2 extent, float part) {
#ifdef SEEN_TILES
    if (TEXEL_SAMPLES > 0u) {
        add_samples(sums, position, extent, part);
        return;
    }
#endif
    add_all_texels(sums, position, part);
}

// A part of each lobe is shared as by the bins, the rest, if any is left, as by the old ones. (A
// loop, because lavapipe skips no branch.)
void add_parts(inout bin_sums sums, ivec2 position, ivec2 extent) {
    float old_part = PARTITION == PARTITION_FITTED ? binning.largest.z : 0.0;
    float part = 1.0 - old_part;
    int first = 0;
    do {
        for (int i = 0; i < BINS; ++i)
            current_bins[i] = binning.bins[first + i];
        add_points(sums, position, extent, part);
        part = old_part;
        first += MOMENT_MAXIMUM_BINS;
    } while (first == MOMENT_MAXIMUM_BINS && old_part > 0.0);
}

void main() {
    ivec2 position, extent = imageSize(moment_map).xy;
    if (!find_target_texel(constants.level, extent, position))
        return;
    bin_sums sums;
    sums.diffuse = vec4(0.0);
    for (int i = 0; i < BINS; ++i) {
        sums.place[i] = sums.spread[i] = vec4(0.0);
        sums.colour[i] = vec4(0.0);
    }
    add_parts(sums, position, extent);
    int layers = BIN_COLOUR ? 3 : 2;
    for (int i = 0; i < BINS; ++i) {
        imageStore(moment_map, ivec3(position, layers * i), sums.place[i]);
        imageStore(moment_map, ivec3(position, layers * i + 1), sums.spread[i]);
        if (BIN_COLOUR)
            imageStore(moment_map, ivec3(position, layers * i + 2), sums.colour[i]);
    }
    if (BIN_COLOUR || MASKED_LOBES)
        imageStore(moment_map, ivec3(position, layers * BINS), sums.diffuse);
}
