#version 460
#extension GL_GOOGLE_include_directive : require

// Where shading must not blend the components of neighbouring texels of a mixture's map, but
// evaluate them one by one: texels that find components of their own have others than their
// neighbours, and halfway between two that differ a blend would be what neither has. A thread for
// each texel of a level, for the four of which it is the first.

#include "interface/gaussian_mixture.h"
#include "interface/moment_bins.h"
#include "lib/lobe/plane_gaussian.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = SPECIALISE_BINS) const uint BINS = 4;
layout(constant_id = SPECIALISE_BIN_COLOUR) const bool BIN_COLOUR = false;

layout(set = 0, binding = 0) uniform sampler2DArray moment_map;
layout(set = 0, binding = 1, std140) uniform binning_block { moment_binning_constants binning; };
layout(set = 0, binding = 2) uniform writeonly image2DArray likeness_map;

layout(push_constant) uniform constants_block { mixture_likeness_constants constants; };

const int LAYERS = BIN_COLOUR ? 3 : 2;

// Sums over a component's lobes, of places and of squared places (xx, yy, xy), and the mean
// sharpness of base lobes, times the mass.
struct component_sums {
    float mass;
    vec2 place;
    vec3 square;
    float sharpness;
};

component_sums read_sums(ivec2 texel, int level, int index) {
    vec4 place = texelFetch(moment_map, ivec3(texel, LAYERS * index), level);
    vec3 square = texelFetch(moment_map, ivec3(texel, LAYERS * index + 1), level).xyz;
    vec4 range = binning.bins[0].range;
    return component_sums(max(place.x, 0.0), range.z * place.yz, range.z * range.z * square,
                          range.w * place.w);
}

void add(inout component_sums sums, component_sums other, float weight) {
    sums.mass += weight * other.mass;
    sums.place += weight * other.place;
    sums.square += weight * other.square;
    sums.sharpness += weight * other.sharpness;
}

component_sums halfway(component_sums a, component_sums b) {
    component_sums sums = component_sums(0.0, vec2(0.0), vec3(0.0), 0.0);
    add(sums, a, 0.5);
    add(sums, b, 0.5);
    return sums;
}

// Base lobes count by their mean sharpness, not their mean variance: a few sharp ones show most
// where a blend puts them.
struct component_bell {
    float mass;
    vec2 mean;
    vec3 covariance;
};

component_bell bell_of(component_sums sums) {
    float scale = 1.0 / max(sums.mass, 1e-6);
    float sharpness = max(scale * sums.sharpness, 0.4);
    vec2 mean = scale * sums.place;
    return component_bell(sums.mass, mean,
                          covariance_of(mean, scale * sums.square) +
                              vec3(vec2(1.0 / (sharpness * sharpness)), 0.0));
}

float overlap(component_bell a, component_bell b) {
    return a.mass * b.mass *
           evaluate_plane_gaussian(make_plane_gaussian(a.covariance + b.covariance, 1.0),
                                   a.mean - b.mean);
}

// The squared difference between the blend of one component halfway and both halves, and both
// halves squared.
vec2 error_of_blend(component_sums one, component_sums other) {
    component_bell a = bell_of(one), b = bell_of(other), blend = bell_of(halfway(one, other));
    float halves = 0.25 * (overlap(a, a) + overlap(b, b)) + 0.5 * overlap(a, b);
    return vec2(max(halves + overlap(blend, blend) - overlap(a, blend) - overlap(b, blend), 0.0),
                halves);
}

struct texel_sums {
    component_sums components[MIXTURE_MAXIMUM_COMPONENTS];
};

// The errors of all components count together, since they may add up; and each counts by itself,
// relative to its own component and weighted by mass, since a sharp component would hide the error
// of a broad one.
bool are_unlike(texel_sums one, texel_sums other) {
    float roots = 0.0, halves = 0.0, parts = 0.0, mass = 0.0;
    for (int j = 0; j < BINS; ++j) {
        float own_mass = 0.5 * (one.components[j].mass + other.components[j].mass);
        vec2 error = error_of_blend(one.components[j], other.components[j]);
        roots += sqrt(error.x);
        halves += error.y;
        parts += own_mass * error.x / max(error.y, 1e-20);
        mass += own_mass;
    }
    return roots * roots > constants.tolerance * halves || parts > constants.tolerance * mass;
}

// The mean of the texels from `low` to `high`.
texel_sums mean_of_texels(ivec2 low, ivec2 high, int level) {
    ivec2 size = textureSize(moment_map, level).xy, count = high - low + 1;
    texel_sums mean;
    for (int j = 0; j < BINS; ++j)
        mean.components[j] = component_sums(0.0, vec2(0.0), vec3(0.0), 0.0);
    for (int i = 0; i < count.x * count.y; ++i) {
        ivec2 texel = (low + ivec2(i % count.x, i / count.x) + size) % size;
        for (int j = 0; j < BINS; ++j)
            add(mean.components[j], read_sums(texel, level, j), 1.0 / float(count.x * count.y));
    }
    return mean;
}

// Two of the four texels that start at `first`.
bool four_are_unlike(ivec2 first, int level) {
    for (int i = 0; i < 3; ++i) {
        ivec2 at = first + ivec2(i & 1, i >> 1);
        texel_sums sums = mean_of_texels(at, at, level);
        for (int k = i + 1; k < 4; ++k) {
            ivec2 other = first + ivec2(k & 1, k >> 1);
            if (are_unlike(sums, mean_of_texels(other, other, level)))
                return true;
        }
    }
    return false;
}

// The four texels, from what a sampler blends of the next level anywhere between their centres.
// Each may be like its own parent and that like its neighbours, but not these: a component that has
// nothing is like all others.
bool levels_are_unlike(ivec2 first, int level) {
    if (level + 1 >= textureQueryLevels(moment_map))
        return false;
    ivec2 low = first / 2 - 1 + (first & 1), high = first / 2 + 1;
    return are_unlike(mean_of_texels(first, first + 1, level),
                      mean_of_texels(low, high, level + 1));
}

float unlikeness(ivec2 first, int level) {
    return four_are_unlike(first, level) ? 1.0 : levels_are_unlike(first, level) ? 0.5 : 0.0;
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(likeness_map).xy;
    if (any(greaterThanEqual(texel, size)))
        return;
    float result = 0.0;
    // Where the map is mirrored, the four also lie on the other side.
    for (uint i = 0u; i < 4u; ++i) {
        uvec2 side = uvec2(i & 1u, i >> 1u);
        if (side.x <= constants.mirrored_x && side.y <= constants.mirrored_y)
            result = max(result, unlikeness((texel + size - ivec2(side)) % size,
                                            int(constants.level)));
    }
    imageStore(likeness_map, ivec3(texel, 0), vec4(result));
}
