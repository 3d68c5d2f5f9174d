#version 460
#extension GL_GOOGLE_include_directive : require

// The sizes of the edges of each patch, and how many vertices and triangles all patches take for
// several distances of vertices. An edge's size is the log2 of its length over that distance, in
// pixels as seen at the nearest point of the sphere around it: the same for both of its patches,
// and whichever way the camera looks. Vertices are not closer than texels. Patches have none unless
// they or their shadows may be in the picture.

#include "displacement/coordinates.glsl"
#include "displacement/patches.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 11, std430) writeonly buffer patch_block { vec4 patches[]; };
layout(set = 0, binding = 12, std430) buffer sum_block { uint sums[]; };

shared uint group_sums[PATCH_SUMS];

float pixel_size(vec3 first, vec3 second) {
    precise float size = length(first - second);
    precise vec3 centre = 0.5 * (first + second);
    float near = view_distance(centre) - 0.5 * size;
    return log2(size * pixels_per_metre(max(near, constants.near_plane)) / constants.spacing);
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

// Texels along an edge of a patch, from corner `first` to the next.
float patch_texels(base_patch parts, int first) {
    ivec3 a = parts.corners[first], b = parts.corners[(first + 1) % 3];
    float rows = float(1 << constants.depth);
    int edge = a.z == 0 && b.z == 0 ? 0 : a.x == 0 && b.x == 0 ? 1 : a.y == 0 && b.y == 0 ? 2 : -1;
    return edge < 0 ? triangle_texels(parts.triangle, vec3(b - a) / rows)
                    : edge_texels(triangles[parts.triangle].edges[edge]) / rows;
}

bool is_in_picture(vec3 centre, float radius) {
    bool seen = true;
    for (int i = 0; i < 5; ++i)
        seen = seen && dot(constants.planes[i], vec4(centre, 1.0)) >= -radius;
    return seen;
}

// A shadow is the sphere moved along the light, and grows if the light is near: whether it is
// inside of all planes at the same time.
bool is_shadow_in_picture(vec4 caster, vec3 centre, float radius) {
    vec3 along = caster.w > 0.0 ? centre - caster.xyz : caster.xyz;
    float from = 0.0, to = 1e30;
    for (int i = 0; i < 5; ++i) {
        float inside = dot(constants.planes[i], vec4(centre, 1.0)) + radius;
        float change = dot(constants.planes[i].xyz, along) + caster.w * radius;
        if (change > 0.0)
            from = max(from, -inside / change);
        else if (change < 0.0)
            to = min(to, -inside / change);
        else if (inside < 0.0)
            return false;
    }
    return from <= to;
}

bool has_shadow_in_picture(vec3 centre, float radius) {
    if (constants.caster_count > PATCH_CASTERS)
        return true;
    for (uint i = 0u; i < constants.caster_count; ++i)
        if (is_shadow_in_picture(constants.casters[i], centre, radius))
            return true;
    return false;
}

float edge_size(base_patch parts, int first, vec3 corners[3]) {
    vec3 begin = corners[first], end = corners[(first + 1) % 3];
    float size = min(pixel_size(begin, end), log2(patch_texels(parts, first)));
    if (constants.caster_count > 0u) {
        precise vec3 centre = 0.5 * (begin + end);
        precise float radius = 0.5 * length(begin - end) + constants.reach;
        if (!is_in_picture(centre, radius))
            size -= float(PATCH_UNSEEN);
    }
    return clamp(size, 0.0, float(PATCH_MOST));
}

bool is_drawn(vec3 corners[3]) {
    vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    float radius = max(max(length(corners[0] - centre), length(corners[1] - centre)),
                       length(corners[2] - centre)) + constants.reach;
    return is_in_picture(centre, radius) || has_shadow_in_picture(centre, radius);
}

vec4 patch_sizes(uint number) {
    base_patch parts = patch_of(number);
    vec3 corners[3];
    for (int i = 0; i < 3; ++i) {
        ivec3 weights = ivec3(i == 0, i == 1, i == 2);
        corners[i] = world_position(site_position(site_of(place_in_patch(parts, weights, 1))));
    }
    if (!is_drawn(corners))
        return vec4(PATCH_CULLED);
    vec3 sizes = vec3(edge_size(parts, 0, corners), edge_size(parts, 1, corners),
                      edge_size(parts, 2, corners));
    return vec4(sizes, max(max(sizes.x, sizes.y), sizes.z));
}

void main() {
    uint number = gl_GlobalInvocationID.y * constants.row + gl_GlobalInvocationID.x;
    bool exists = gl_GlobalInvocationID.x < constants.row && number < constants.patch_count;
    if (gl_LocalInvocationIndex < PATCH_SUMS)
        group_sums[gl_LocalInvocationIndex] = 0u;
    barrier();
    if (exists) {
        vec4 sizes = patch_sizes(number);
        patches[number] = sizes;
        for (uint i = 0u; i < PATCH_SPACINGS; ++i) {
            uvec2 counts = patch_counts(sizes.w, i);
            atomicAdd(group_sums[i], counts.x);
            atomicAdd(group_sums[PATCH_SPACINGS + i], counts.y);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex < PATCH_SUMS)
        atomicAdd(sums[gl_LocalInvocationIndex], group_sums[gl_LocalInvocationIndex]);
}
