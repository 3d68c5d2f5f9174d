#version 460
#extension GL_GOOGLE_include_directive : require

// Chooses how many samples each pixel takes, from the first sample of it and of its neighbours.
// What one fetch cannot hold (an edge, a crease, a highlight's rim, a footprint much longer than
// wide) differs from pixel to pixel; what it can hold was filtered and varies slowly. The measure
// is the contrast with the neighbours, in units of the picture's key: an error far below the key is
// neither seen nor counts in a mean of squares.

#include "interface/picture/sample_choice.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform constants_block { sample_choice_constants constants; };
layout(set = 0, binding = 0) uniform sampler2D radiance; // alpha: depth, 0 where nothing is hit
layout(set = 0, binding = 1, std430) readonly buffer sum_block { key_sum sums[]; };
layout(set = 0, binding = 2, r32f) writeonly uniform image2D counts;
layout(set = 0, binding = 3, std430) buffer list_block { uint list[]; };

// Contrasts, in keys, above which a pixel takes more samples: anywhere, and where the surface bends
// or breaks, so that every fetch of the pixel's own side misses the other. Chosen on checkerboard,
// three photographed materials and the flight helmet, for moments, lobes and toksvig: at 1.4 more
// samples for each pixel that hits something, the error falls by a quarter (with eight samples
// everywhere by 38 %).
const float CONTRAST = 0.8;
const float CONTRAST_AT_EDGES = 0.3;
// Change of slope from pixel to pixel that counts as an edge.
const float EDGE_SLOPE = 1.0;

shared vec2 partial[64];
shared uint listed, first_entry;

// The picture's key, from the sums of its tiles; see picture_key.comp.
float picture_key() {
    vec2 sum = vec2(0.0);
    for (uint i = gl_LocalInvocationIndex; i < constants.tiles; i += 64u)
        sum += vec2(sums[i].roots, sums[i].pixels);
    partial[gl_LocalInvocationIndex] = sum;
    for (uint half_count = 32u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (gl_LocalInvocationIndex < half_count)
            partial[gl_LocalInvocationIndex] += partial[gl_LocalInvocationIndex + half_count];
    }
    barrier();
    float mean = partial[0].x / max(partial[0].y, 1.0);
    return mean * mean;
}

vec4 first_sample(ivec2 position, ivec2 size) {
    return texelFetch(radiance, clamp(position, ivec2(0), size - 1), 0);
}

// Largest difference in any channel.
float contrast(vec4 a, vec4 b) {
    vec3 difference = abs(a.rgb - b.rgb);
    bool silhouette = constants.blended != 0u && (a.a > 0.0) != (b.a > 0.0);
    return silhouette ? 1e30 : max(difference.r, max(difference.g, difference.b));
}

// How much the surface's slope changes from `a` over `centre` to `b`; see
// passes_camera_slope_scale.
float slope_change(float a, float centre, float b) {
    float nearest = max(centre, max(a, b));
    return abs(a + b - 2.0 * centre) /
           max(nearest * constants.depth_scale + constants.depth_offset, 1e-30);
}

bool needs_samples(ivec2 position, ivec2 size, float key) {
    vec4 centre = first_sample(position, size);
    float most = 0.0, bend = 0.0;
    for (int i = 0; i < 2; ++i) {
        ivec2 offset = ivec2(1 - i, i);
        vec4 a = first_sample(position - offset, size), b = first_sample(position + offset, size);
        most = max(most, max(contrast(a, centre), contrast(b, centre)));
        bend = max(bend, slope_change(a.a, centre.a, b.a));
    }
    return most > key * (bend > EDGE_SLOPE ? CONTRAST_AT_EDGES : CONTRAST);
}

// One atomic addition to the list's length for each group.
void list_pixel(bool takes_more, ivec2 position) {
    uint entry = 0u;
    if (gl_LocalInvocationIndex == 0u)
        listed = 0u;
    barrier();
    if (takes_more)
        entry = atomicAdd(listed, 1u);
    barrier();
    if (gl_LocalInvocationIndex == 0u && listed > 0u)
        first_entry = atomicAdd(list[0], listed);
    barrier();
    if (takes_more)
        list[SAMPLE_LIST_FIRST + first_entry + entry] = uint(position.y) << 16 | uint(position.x);
}

void main() {
    ivec2 size = textureSize(radiance, 0), position = ivec2(gl_GlobalInvocationID.xy);
    float key = picture_key();
    bool inside = all(lessThan(position, size)), takes_more = false;
    if (inside && constants.most > 1u)
        takes_more = constants.everywhere != 0u || needs_samples(position, size, key);
    if (inside)
        imageStore(counts, position, vec4(takes_more ? float(constants.most) : 1.0));
    list_pixel(takes_more, position);
}
