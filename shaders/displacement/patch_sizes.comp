#version 460
#extension GL_GOOGLE_include_directive : require

// The sizes of the edges of each patch, and how many patches have which size. An edge's size is the
// log2 of its length over the distance of vertices, in pixels as seen at the nearest point of the
// sphere around it: the same for both of its patches, and whichever way the camera looks. Vertices
// are not closer than texels. Patches have none unless they or their shadows may be in the picture
// (patch_culling.glsl).

#include "displacement/patch_culling.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 11, std430) writeonly buffer patch_block { vec4 patches[]; };
layout(set = 0, binding = 12, std430) buffer bin_block { uint bins[]; };

shared uint group_bins[PATCH_BINS];

float pixel_size(base_site middle, float size) {
    float pixels = constants.pixels;
    if (constants.perspective != 0.0)
        pixels /= max(view_distance(distant_position(middle)) - 0.5 * size, constants.near_plane);
    return log2(size * pixels / constants.spacing);
}

vec2 in_texels(vec2 coordinates) {
    return coordinates * vec2(constants.width, constants.height);
}

// Across a whole edge of the mesh: the most of its charts.
float edge_texels(uint edge) {
    float most = 0.0;
    for (uint i = 0u; i < edges[edge].pair_count; ++i) {
        uint pair = 2u * (edges[edge].first_pair + i);
        most = max(most, length(in_texels(chart_coordinates(pairs[pair + 1u]) -
                                          chart_coordinates(pairs[pair]))));
    }
    return most;
}

float triangle_texels(uint triangle, vec3 weights) {
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 3; ++i)
        sum += weights[i] * chart_coordinates(triangles[triangle].charts[i]);
    return length(in_texels(sum));
}

// The first edge of a patch: from corner 0 to corner 1.

float patch_texels(base_patch parts) {
    ivec3 a = parts.corners[0], b = parts.corners[1];
    float rows = float(1 << constants.depth);
    int edge = a.z == 0 && b.z == 0 ? 0 : a.x == 0 && b.x == 0 ? 1 : a.y == 0 && b.y == 0 ? 2 : -1;
    return edge < 0 ? triangle_texels(parts.triangle, vec3(b - a) / rows)
                    : edge_texels(triangles[parts.triangle].edges[edge]) / rows;
}

float edge_size(base_patch parts, vec3 corners[3]) {
    base_site middle = site_of(place_in_patch(parts, ivec3(1, 1, 0), 2));
    precise float length_of_edge = length(corners[0] - corners[1]);
    float size = min(pixel_size(middle, length_of_edge), log2(patch_texels(parts)));
    if (constants.caster_count > 0u)
        size -= float(PATCH_UNSEEN) * (1.0 - presence_of_edge(middle, length_of_edge));
    return clamp(size, -1.0, float(PATCH_MOST)); // from -1 to 0 it is one segment
}

// The edges take turns as the first, so that the code for an edge exists once: drivers take seconds
// for three times as much.
vec3 edge_sizes(base_patch parts, vec3 corners[3]) {
    vec3 sizes = vec3(0.0);
    [[dont_unroll]]
    for (int i = 0; i < 3; ++i) {
        sizes = vec3(sizes.yz, edge_size(parts, corners));
        parts.corners = ivec3[3](parts.corners[1], parts.corners[2], parts.corners[0]);
        corners = vec3[3](corners[1], corners[2], corners[0]);
    }
    return sizes;
}

vec4 patch_sizes(uint number, out float presence) {
    base_patch parts = patch_of(number);
    base_site sites[3];
    vec3 corners[3];
    [[dont_unroll]]
    for (int i = 0; i < 3; ++i) {
        ivec3 weights = ivec3(i == 0, i == 1, i == 2);
        sites[i] = site_of(place_in_patch(parts, weights, 1));
        corners[i] = world_position(site_position(sites[i]));
    }
    presence = presence_of_patch(parts, sites, corners);
    if (presence == 0.0)
        return vec4(PATCH_CULLED);
    vec3 sizes = edge_sizes(parts, corners);
    return vec4(sizes, max(max(sizes.x, sizes.y), sizes.z));
}

// Counts a patch in the two bins above its largest edge's size: half-way between bins in both, so
// that nothing jumps when sizes change.
void count_patch(float largest, float presence) {
    float place = (largest + 1.0) * float(PATCH_STEPS);
    uint bin = min(uint(ceil(place)), PATCH_BINS - 2u); // whatever a driver makes of no number
    uint all = uint(round(presence * float(PATCH_BIN_UNITS)));
    uint units = uint(round((float(bin) - place) * float(all)));
    atomicAdd(group_bins[bin], units);
    atomicAdd(group_bins[bin + 1u], all - units);
}

void main() {
    uint number = gl_GlobalInvocationID.y * constants.row + gl_GlobalInvocationID.x;
    bool exists = gl_GlobalInvocationID.x < constants.row && number < constants.patch_count;
    for (uint i = gl_LocalInvocationIndex; i < PATCH_BINS; i += 64u)
        group_bins[i] = 0u;
    barrier();
    if (exists) {
        float presence;
        vec4 sizes = patch_sizes(number, presence);
        patches[number] = presence == 1.0 ? sizes : vec4(PATCH_CULLED);
        if (presence > 0.0)
            count_patch(sizes.w, presence);
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < PATCH_BINS; i += 64u)
        if (group_bins[i] != 0u)
            atomicAdd(bins[i], group_bins[i]);
}
