#version 460
#extension GL_GOOGLE_include_directive : require

// The base lobes of each texel of a material's maps as samples for mixtures of Gaussians, and what
// all of them are within. Where maps are interpolated, a sample is the mean over points of the
// texel: under a mask, over two of those that it keeps. A Gaussian of all would be as wide as they
// differ, and components could not tell them apart.

#include "interface/gaussian_mixture.h"
#include "interface/moment_bins.h"
#include "lib/microfacet/slope_distribution.glsl"
#include "lib/number/hash.glsl"
#include "maps/plane_lobes.glsl"

const uint SIDE = 8, THREADS = SIDE * SIDE;

layout(local_size_x = SIDE, local_size_y = SIDE) in;

layout(constant_id = SPECIALISE_BIN_COLOUR) const bool BIN_COLOUR = false;
layout(constant_id = SPECIALISE_MIXTURE_PLANE) const uint PLANE = MIXTURE_PLANE_LAMBERT;

layout(set = 0, binding = 16) uniform writeonly image2DArray sample_map;
layout(set = 0, binding = 17, std430) writeonly buffer extremes_block {
    mixture_extremes extremes[];
};

layout(push_constant) uniform constants_block { lobe_grid_constants constants; };

shared mixture_extremes least[THREADS];

struct lobe_sums {
    float mass;
    vec4 lobe;   // m p, m / sqrt(v), m v
    vec3 square; // m p p
    vec4 colour;
};

const int LAYERS = BIN_COLOUR ? 3 : 2;

void extend_colours(vec3 colour, inout mixture_extremes own) {
    own.lobes.w = min(own.lobes.w, -max(colour.r, max(colour.g, colour.b)));
}

// Base lobe `i` in the mixture's plane.
plane_lobe lobe_in_plane(int i, vec3 normal, float factor, vec4 specular) {
    plane_lobe lobe = make_lobe(i, normal, factor, specular);
    if (PLANE == MIXTURE_PLANE_PROJECTED) {
        vec3 axis = direction_from_plane(lobe.place);
        lobe.place = axis.z > 0.0 ? axis.xy : axis.xy / max(length(axis.xy), 1e-6);
        // The mean of outwards and around; at most that of all directions alike, cosine-weighted.
        lobe.variance = min(lobe.variance * (0.5 + 0.5 * axis.z * axis.z), 0.25);
        lobe.mass = MODEL == MODEL_MICROFACET ? 1.0 : material.lobe_colour[i].w;
    }
    if (PLANE == MIXTURE_PLANE_SLOPES) {
        lobe.place = slope_of_normal(direction_from_plane(lobe.place));
        // As for one Gaussian of slopes (maps/slope_moments.comp).
        lobe.variance = 1.0 / max(base_concentration(i, factor), 1.0);
        lobe.mass = MODEL == MODEL_MICROFACET ? 1.0 : material.lobe_colour[i].w;
    }
    return lobe;
}

// The points that a sample is made of, and how much each counts.
struct sample_points {
    vec2 points[2];
    float weight;
};

const int SAMPLE_POINTS = POINTS > 1 ? 2 : 1;

vec2 point_of_texel(ivec2 texel, int index) {
    return map_point(texel, index, ivec2(constants.width, constants.height));
}

float weight_at(vec2 point) {
    return weight_of_point(point, constants.alpha, constants.cutoff);
}

vec3 base_colour_of(vec2 point) {
    return value_at(MAP_BASE_COLOUR, base_colour_map, point).rgb;
}

// The number of the bit that has `index` others below it.
int find_bit(uint bits, int index) {
    for (int i = 0; i < index; ++i)
        bits &= bits - 1u;
    return findLSB(bits);
}

// Two at random of all that are kept, not far apart: bit `i` of `kept` is point `i`.
sample_points choose_points(ivec2 texel, uint kept, float weight) {
    int count = bitCount(kept);
    int first = int(hash(uint(texel.x) + hash(uint(texel.y))) % uint(count));
    int second = (first + 2) % count;
    return sample_points(vec2[](point_of_texel(texel, find_bit(kept, first)),
                                point_of_texel(texel, find_bit(kept, second))), weight);
}

sample_points points_of_sample(ivec2 texel) {
    if (!MANY_POINTS) {
        vec2 first = point_of_texel(texel, 0);
        return sample_points(vec2[](first, point_of_texel(texel, SAMPLE_POINTS - 1)),
                             weight_at(first));
    }
    uint kept = 0u;
    float weight = 0.0;
    for (int k = 0; k < POINTS; ++k) {
        float own = weight_at(point_of_texel(texel, k));
        kept |= own == 1.0 ? 1u << k : 0u;
        weight += own / float(POINTS);
    }
    return choose_points(texel, kept == 0u ? (1u << POINTS) - 1u : kept, weight);
}

// Sums over the texel's points of base lobe `i`.
lobe_sums sum_points(sample_points chosen, int i, inout mixture_extremes own) {
    lobe_sums sums = lobe_sums(0.0, vec4(0.0), vec3(0.0), vec4(0.0));
    for (int k = 0; k < SAMPLE_POINTS; ++k) {
        vec2 point = chosen.points[k];
        vec4 specular = vec4(0.0);
        vec3 diffuse;
        if (BIN_COLOUR) {
            colours_at(point, base_colour_of(point), specular, diffuse);
            specular.rgb /= material.largest_colour;
        }
        vec3 normal = normal_at(point, constants.alpha, constants.cutoff);
        plane_lobe lobe = lobe_in_plane(i, normal, width_at(point), specular);
        // Lobes without mass have a place and a width, too.
        float weight = chosen.weight / float(SAMPLE_POINTS);
        float mass = weight * max(lobe.mass, 1e-20), sharpness = inversesqrt(lobe.variance);
        sums.mass += mass;
        sums.lobe += mass * vec4(lobe.place, sharpness, lobe.variance);
        sums.square += mass * vec3(lobe.place * lobe.place, lobe.place.x * lobe.place.y);
        sums.colour += mass * lobe.colour;
        own.places = min(own.places, vec4(lobe.place, -lobe.place));
        own.lobes.xy = min(own.lobes.xy, -vec2(sharpness, lobe.variance));
        if (BIN_COLOUR)
            extend_colours(lobe.colour.rgb, own);
    }
    return sums;
}

// The diffuse colour, and how much the texel counts.
vec4 last_of_texel(ivec2 texel, inout mixture_extremes own) {
    vec4 sum = vec4(0.0);
    for (int k = 0; k < POINTS; ++k) {
        vec2 point = point_of_texel(texel, k);
        vec4 specular;
        vec3 diffuse = vec3(0.0);
        if (BIN_COLOUR)
            colours_at(point, base_colour_of(point), specular, diffuse);
        sum += weight_at(point) / float(POINTS) * vec4(diffuse / material.largest_colour, 1.0);
    }
    extend_colours(sum.rgb, own);
    return sum;
}

void write_texel(ivec2 texel, inout mixture_extremes own) {
    float whole = 0.0;
    sample_points chosen = points_of_sample(texel);
    for (int i = 0; i < LOBE_COUNT; ++i) {
        lobe_sums sums = sum_points(chosen, i, own);
        vec4 mean = sums.lobe / max(sums.mass, 1e-30);
        vec3 square = vec3(mean.xy * mean.xy, mean.x * mean.y);
        vec3 covariance = sums.square / max(sums.mass, 1e-30) - square;
        covariance.xy = max(covariance.xy, vec2(0.0));
        imageStore(sample_map, ivec3(texel, LAYERS * i), mean);
        imageStore(sample_map, ivec3(texel, LAYERS * i + 1),
                   vec4(POINTS == 1 ? vec3(0.0) : covariance, sums.mass));
        if (BIN_COLOUR)
            imageStore(sample_map, ivec3(texel, LAYERS * i + 2),
                       sums.colour / max(sums.mass, 1e-30));
        whole += sums.mass;
    }
    own.lobes.z = min(own.lobes.z, -whole);
    if (BIN_COLOUR || MASKED_LOBES)
        imageStore(sample_map, ivec3(texel, LAYERS * int(LOBE_COUNT)), last_of_texel(texel, own));
}

// Of the group's threads.
void write_extremes(uint thread, uint tile) {
    for (uint count = THREADS / 2; count > 0; count /= 2) {
        barrier();
        if (thread < count) {
            least[thread].places = min(least[thread].places, least[thread + count].places);
            least[thread].lobes = min(least[thread].lobes, least[thread + count].lobes);
        }
    }
    if (thread == 0)
        extremes[tile] = least[0];
}

void main() {
    uvec2 first = gl_WorkGroupID.xy * MIXTURE_TILE + gl_LocalInvocationID.xy;
    uvec2 end = min((gl_WorkGroupID.xy + 1u) * MIXTURE_TILE,
                    uvec2(constants.width, constants.height));
    uint thread = gl_LocalInvocationIndex;
    mixture_extremes own = mixture_extremes(vec4(1e30), vec4(1e30));
    for (uint y = first.y; y < end.y; y += SIDE)
        for (uint x = first.x; x < end.x; x += SIDE)
            write_texel(ivec2(x, y), own);
    least[thread] = own;
    write_extremes(thread, gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
}
