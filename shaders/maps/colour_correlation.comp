#version 460
#extension GL_GOOGLE_include_directive : require

// Whether diffuse colours go with normals somewhere on a material's maps, so that the mean of their
// products is not the product of their means. One group, a thread for each of 8 by 8 patches of the
// maps, which reads 8 by 8 texels of it. All sums are in a fixed order.

#include "interface/colours/colour_correlation.h"
#include "interface/material.h"
#include "interface/specialisation.h"
#include "lib/map/normal_map.glsl"
#include "lib/number/finite.glsl"
#include "lib/number/hash.glsl"

const uint PATCHES = 8, SAMPLES = 8; // along each axis
const uint THREADS = PATCHES * PATCHES;

layout(local_size_x = THREADS) in;

// The least root mean square, over patches, of the covariance of colour and normal, over the mean
// colour: light that grazes the surface is brighter or darker by that much.
const float LEAST_COVARIANCE = 0.04;

layout(set = 0, binding = 4) uniform sampler2D base_colour_map;
layout(set = 0, binding = 5) uniform sampler2D normal_map;
layout(set = 0, binding = 6) uniform sampler2D width_map;
layout(set = 0, binding = 16, std430) writeonly buffer correlation_block {
    colour_correlation_found found;
};

layout(push_constant) uniform constants_block { colour_correlation_constants constants; };

// What is measured of a patch: sums of the normal's x and y, of the colour, and of products.
struct patch_sums {
    float count;
    vec2 normal, normal_squares;
    vec3 colour, colour_squares;
    mat2x3 products; // a column for each coordinate of the normal
};

shared vec3 totals[THREADS]; // square of the covariance, colour, count

uvec2 extent() {
    return uvec2(constants.width, constants.height);
}

// A texel within a stratum of a patch, so that no period of a map is that of the samples.
uvec2 place_of(uvec2 patch_position, uint i) {
    uint number = 2u * (gl_LocalInvocationID.x * SAMPLES * SAMPLES + i);
    vec2 inside = vec2(hashed_number(number), hashed_number(number + 1u));
    uvec2 stratum = patch_position * SAMPLES + uvec2(i % SAMPLES, i / SAMPLES);
    vec2 place = (vec2(stratum) + inside) / float(PATCHES * SAMPLES) * vec2(extent());
    return min(uvec2(place), extent() - 1u);
}

// A map's texel at one of the grid.
vec4 texel_at(sampler2D map, uvec2 place) {
    uvec2 size = uvec2(textureSize(map, 0));
    return finite_or_zero(texelFetch(map, ivec2(place * size / extent()), 0));
}

// Without what a mask cuts away.
void add_texel(uvec2 place, inout patch_sums sums) {
    vec4 base = texel_at(base_colour_map, place);
    if (base.a * constants.alpha < constants.cutoff)
        return;
    vec2 point = (vec2(place) + 0.5) / vec2(extent());
    vec2 normal = decode_normal(textureLod(normal_map, point, 0.0).xyz, constants.normal_scale,
                                constants.normals)
                      .xy;
    vec3 colour = base.rgb * (1.0 - constants.metallic * texel_at(width_map, place).b);
    sums.count += 1.0;
    sums.normal += normal;
    sums.normal_squares += normal * normal;
    sums.colour += colour;
    sums.colour_squares += colour * colour;
    sums.products += outerProduct(colour, normal);
}

// The square of the covariance, of all channels with the normal, without what so many texels have
// by chance.
float square_of_covariance(patch_sums sums) {
    float texels = max(float(constants.width) * float(constants.height) / float(THREADS), 1.0);
    if (sums.count < 2.0)
        return 0.0;
    vec2 normal = sums.normal / sums.count;
    vec2 variance = sums.normal_squares / sums.count - normal * normal;
    vec3 colour = sums.colour / sums.count;
    vec3 spread = sums.colour_squares / sums.count - colour * colour;
    float square = 0.0;
    for (int i = 0; i < 2; ++i) {
        vec3 covariance = sums.products[i] / sums.count - normal[i] * colour;
        square += dot(covariance, covariance) -
                  variance[i] * (spread.r + spread.g + spread.b) / min(sums.count, texels);
    }
    return square;
}

vec3 measure(uint index) {
    patch_sums sums =
        patch_sums(0.0, vec2(0.0), vec2(0.0), vec3(0.0), vec3(0.0), mat2x3(0.0));
    for (uint i = 0; i < SAMPLES * SAMPLES; ++i)
        add_texel(place_of(uvec2(index % PATCHES, index / PATCHES), i), sums);
    return vec3(square_of_covariance(sums), sums.colour.r + sums.colour.g + sums.colour.b,
                sums.count);
}

// The map has half the grid's size. Its finest level has a thread for all layers.
uvec4 groups_of(uint level) {
    uvec2 size = max(max(extent() / 2u, 1u) >> level, 1u);
    return uvec4((size + 7u) / 8u, level == 0u ? 1u : COLOUR_NORMALS_LAYERS, 0u);
}

void main() {
    uint thread = gl_LocalInvocationID.x;
    totals[thread] = measure(thread);
    for (uint half_size = THREADS / 2; half_size > 0; half_size /= 2) {
        barrier();
        if (thread < half_size)
            totals[thread] += totals[thread + half_size];
    }
    barrier();
    float square = totals[0].x / float(THREADS), colour = totals[0].y / max(totals[0].z, 1.0);
    bool follow = square > LEAST_COVARIANCE * LEAST_COVARIANCE * colour * colour / 3.0;
    if (thread == 0)
        found.follow = follow ? 1u : 0u;
    if (thread < COLOUR_CORRELATION_LEVELS)
        found.groups[thread] = follow ? groups_of(thread) : uvec4(0u);
}
