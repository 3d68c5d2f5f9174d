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

// Sums over a component's lobes, of places and of squared places with base lobes.
struct component_sums {
    float mass;
    vec2 place;
    vec3 square; // xx, yy, xy
};

struct component_bell {
    float mass;
    vec2 mean;
    vec3 covariance;
};

component_sums read_sums(ivec2 texel, int level, int index) {
    vec4 place = texelFetch(moment_map, ivec3(texel, LAYERS * index), level);
    vec4 spread = texelFetch(moment_map, ivec3(texel, LAYERS * index + 1), level);
    float range = binning.bins[0].range.z, variance = spread.w * binning.bins[0].shape.w;
    return component_sums(max(place.x, 0.0), range * place.yz,
                          range * range * spread.xyz + vec3(vec2(variance), 0.0));
}

component_sums half_way(component_sums a, component_sums b) {
    return component_sums(0.5 * (a.mass + b.mass), 0.5 * (a.place + b.place),
                          0.5 * (a.square + b.square));
}

component_bell bell_of(component_sums sums) {
    float scale = 1.0 / max(sums.mass, 1e-6);
    vec2 mean = scale * sums.place;
    return component_bell(sums.mass, mean, covariance_of(mean, scale * sums.square));
}

float overlap(component_bell a, component_bell b) {
    return a.mass * b.mass *
           evaluate_plane_gaussian(make_plane_gaussian(a.covariance + b.covariance, 1.0),
                                   a.mean - b.mean);
}

// The squared difference between the blend of one component halfway and both halves.
float error_of_blend(component_sums one, component_sums other) {
    component_bell a = bell_of(one), b = bell_of(other), blend = bell_of(half_way(one, other));
    return 0.25 * (overlap(a, a) + overlap(b, b)) + 0.5 * overlap(a, b) + overlap(blend, blend) -
           overlap(a, blend) - overlap(b, blend);
}

float squared_mixture(component_sums sums[MIXTURE_MAXIMUM_COMPONENTS]) {
    float sum = 0.0;
    for (int i = 0; i < BINS; ++i)
        for (int j = 0; j < BINS; ++j)
            sum += overlap(bell_of(sums[i]), bell_of(sums[j]));
    return sum;
}

// The components of two texels. Their errors may have one sign.
bool are_unlike(component_sums sums[MIXTURE_MAXIMUM_COMPONENTS], float square, ivec2 texel,
                int level) {
    float error = 0.0;
    for (int j = 0; j < BINS; ++j)
        error += sqrt(max(error_of_blend(sums[j], read_sums(texel, level, j)), 0.0));
    return error * error > constants.tolerance * square;
}

float unlikeness(ivec2 first, ivec2 size, int level) {
    float result = 0.0;
    // Against those of the texels that come after it, then against its parent's.
    for (int i = 0; i < 4 && result < 1.0; ++i) {
        ivec2 texel = (first + ivec2(i & 1, i >> 1)) % size;
        component_sums sums[MIXTURE_MAXIMUM_COMPONENTS];
        for (int j = 0; j < BINS; ++j)
            sums[j] = read_sums(texel, level, j);
        float square = squared_mixture(sums);
        for (int k = 0; k < 4 && result < 1.0; ++k)
            if (k != i && are_unlike(sums, square, (first + ivec2(k & 1, k >> 1)) % size, level))
                result = 1.0;
        if (level + 1 >= textureQueryLevels(moment_map))
            continue;
        ivec2 parent = min(texel / 2, textureSize(moment_map, level + 1).xy - 1);
        if (are_unlike(sums, square, parent, level + 1))
            result = max(result, 0.5);
    }
    return result;
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
            result = max(result, unlikeness(texel + size - ivec2(side), size,
                                            int(constants.level)));
    }
    imageStore(likeness_map, ivec3(texel, 0), vec4(result));
}
