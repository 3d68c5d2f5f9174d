#version 460
#extension GL_GOOGLE_include_directive : require

// Chooses the least distance of vertices for which there is room, and gives each patch its place
// among the vertices and triangles, in the order of patches. One group.
//
// The distance follows the camera without a jump: at each distance as much room is left as would be
// needed if all patches divided at once a little later, so that it grows before they do. That costs
// nothing where patches divide one after the other.

#include "displacement/patches.glsl"

layout(local_size_x = PATCH_GROUP) in;

layout(set = 0, binding = 5, std430) readonly buffer patch_block { vec4 patches[]; };
layout(set = 0, binding = 6, std430) readonly buffer bin_block { uint bins[]; };
layout(set = 0, binding = 7, std430) writeonly buffer offset_block { uvec2 offsets[]; };
layout(set = 0, binding = 8, std430) writeonly buffer argument_block { uint arguments[]; };

shared uint least_spacing; // bits of a float
shared uvec2 totals[PATCH_GROUP];

// Log2 of the least distance, over that which was asked for, if `taken` of the room is taken up to
// `spacing`, and from there on half of it for each doubling of the distance.
float spacing_with_room(float taken, float room, float spacing) {
    if (taken <= 0.0)
        return 0.0;
    float doublings = room > 0.0 ? log2(room / taken) : 0.0;
    return spacing - max(doublings, 0.0);
}

// With vertices 2^(step / PATCH_STEPS) times as far apart as was asked for. Each patch has its
// first triangle in any case. A thousandth of the room is for rounding.
float spacing_after(uint step) {
    vec2 taken = vec2(0.0), room = vec2(constants.vertex_room, constants.triangle_room) / 1.001;
    for (uint i = 0u; i < PATCH_BINS; ++i) {
        float count = float(bins[i]) / float(PATCH_BIN_UNITS);
        float size = (float(i) - float(step)) / float(PATCH_STEPS) - 1.0;
        vec2 least = vec2(counts_of(1));
        taken += count * (vec2(counts_of(segments_of(size))) - least);
        room -= count * least;
    }
    float next = float(step + 1u) / float(PATCH_STEPS);
    return max(spacing_with_room(taken.x, room.x, next),
               spacing_with_room(taken.y, room.y, next));
}

float choose_spacing(uint lane) {
    if (lane == 0u)
        least_spacing = 0u;
    barrier();
    for (uint step = lane; step < PATCH_BINS; step += PATCH_GROUP)
        atomicMax(least_spacing, floatBitsToUint(max(spacing_after(step), 0.0)));
    barrier();
    return uintBitsToFloat(least_spacing);
}

void write_groups(uint first, uint count) {
    uint groups = (count + 63u) / 64u; // every device allows 65535 in a dimension
    arguments[first] = min(groups, 65535u);
    arguments[first + 1u] = (groups + 65534u) / 65535u;
    arguments[first + 2u] = 1u;
}

void write_arguments(uvec2 total, float spacing) {
    arguments[PATCH_DRAW] = 3u * total.y;
    arguments[PATCH_DRAW + 1u] = total.y > 0u ? 1u : 0u;
    for (uint i = 2u; i < 5u; ++i)
        arguments[PATCH_DRAW + i] = 0u;
    write_groups(PATCH_VERTICES, total.x);
    write_groups(PATCH_TRIANGLES, total.y);
    arguments[PATCH_SPACING] = floatBitsToUint(spacing);
    arguments[PATCH_TOTALS] = total.x;
    arguments[PATCH_TOTALS + 1u] = total.y;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    float spacing = choose_spacing(lane);
    uint share = (constants.patch_count + PATCH_GROUP - 1u) / PATCH_GROUP;
    uint first = lane * share, end = min(first + share, constants.patch_count);
    uvec2 own = uvec2(0u);
    for (uint i = first; i < end; ++i)
        own += patch_counts(patches[i].w, spacing);
    totals[lane] = own;
    for (uint step = 1u; step < PATCH_GROUP; step *= 2u) {
        barrier();
        uvec2 before = lane >= step ? totals[lane - step] : uvec2(0u);
        barrier();
        totals[lane] += before;
    }
    uvec2 offset = totals[lane] - own;
    for (uint i = first; i < end; ++i) {
        offsets[i] = offset;
        offset += patch_counts(patches[i].w, spacing);
    }
    if (lane == PATCH_GROUP - 1u)
        write_arguments(offset, spacing);
}
