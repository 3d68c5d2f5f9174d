#ifndef HEIGHT_FIELD_GLSL
#define HEIGHT_FIELD_GLSL

// A material's relief (interface/displacement/relief.h), and rays through it.

#include "filters/displaced/relief_texel.glsl"
#include "interface/displacement/relief.h"

#ifndef LOBE_DESCRIPTOR
#define LOBE_DESCRIPTOR(number) set = 0, binding = number
#endif

layout(LOBE_DESCRIPTOR(33), std140) uniform height_field_block { height_field_constants relief; };
layout(LOBE_DESCRIPTOR(34), std430) readonly buffer maxima_block { float maxima[]; };
// Mean and largest height; the mean distance of the facets' normals from the pole in the Lambert
// plane.
layout(LOBE_DESCRIPTOR(35), std430) readonly buffer height_extent_block { vec4 height_extent; };
// Repeated.
layout(LOBE_DESCRIPTOR(51)) uniform sampler2D height_map;

float mean_height() {
    return height_extent.x;
}

float largest_height() {
    return height_extent.y;
}

ivec2 relief_size() {
    return ivec2(relief.width, relief.height);
}

// Into the first period. The remainder of a negative number is undefined in GLSL.
int first_period(int i, int size) {
    int rest = i >= 0 ? i % size : size - 1 - (-1 - i) % size;
    return rest;
}

ivec2 first_period(ivec2 quad) {
    return ivec2(first_period(quad.x, int(relief.width)), first_period(quad.y, int(relief.height)));
}

// ---------------------------------------------------------------------------------------------
// Quads and facets

float height_of(float texel) {
    return height_of_texel(texel, relief.scale, relief.least_value, relief.largest_value);
}

// The heights of a quad's corners: of its vertex, the next along x, along y, and along both.
// `first`: the quad, in the first period; `size`: of that.
vec4 corner_heights(ivec2 first, ivec2 size) {
    vec4 texels = textureGather(height_map, vec2(first + 1) / vec2(size));
    return vec4(height_of(texels.w), height_of(texels.z), height_of(texels.x), height_of(texels.y));
}

// `texel`: in the first period.
float vertex_height(ivec2 texel) {
    return height_of(texelFetch(height_map, texel, 0).r);
}

vec4 quad_heights(ivec2 quad) {
    return corner_heights(first_period(quad), relief_size());
}

// A quad's diagonal from its vertex divides it into facets: lower, where x is the larger, and
// upper.
vec2 facet_slope(vec4 corners, bool upper) {
    return upper ? vec2(corners.w - corners.z, corners.z - corners.x)
                 : vec2(corners.y - corners.x, corners.w - corners.y);
}

vec3 facet_normal(vec2 slope) {
    return normalize(vec3(-slope, 1.0));
}

// ---------------------------------------------------------------------------------------------
// Walking along a ray, over nodes of the levels of maxima; level 0: quads

struct relief_walk {
    // Of the relief, read once: drivers may read what is the same for all threads for each of them.
    ivec2 size;
    int last_level;
    float largest; // height
    vec3 origin;
    vec3 direction;
    vec2 inverse; // of the direction
    ivec2 quad;   // where the walk is
    int level;
    int offset; // of the level's first value
    float place;        // along the ray
    float leave;        // where it leaves the node
    bool leaves_by_x;   // through a side of the node perpendicular to x
    ivec2 tile;         // first quad of the node's period
    ivec2 first, last;  // quads of the node
};

float inverse_of(float x) {
    return x < 0.0 ? 1.0 / min(x, -1e-12) : 1.0 / max(x, 1e-12);
}

// The quad is in the period of the node before, or in one beside it: divisions would take most of
// a step's time.
void find_node(inout relief_walk walk) {
    walk.tile += mix(ivec2(0), walk.size, greaterThanEqual(walk.quad, walk.tile + walk.size)) -
                 mix(ivec2(0), walk.size, lessThan(walk.quad, walk.tile));
    ivec2 local = walk.quad - walk.tile;
    int shift = 2 * walk.level;
    walk.first = walk.tile + ((local >> shift) << shift);
    walk.last = min(walk.first + (1 << shift), walk.tile + walk.size);
    vec2 sides = vec2(walk.direction.x < 0.0 ? walk.first.x : walk.last.x,
                      walk.direction.y < 0.0 ? walk.first.y : walk.last.y);
    vec2 exits = (sides - walk.origin.xy) * walk.inverse;
    walk.leaves_by_x = exits.x < exits.y;
    walk.leave = max(min(exits.x, exits.y), walk.place);
}

// Above the relief, or at level 0 in the middle of facets.
relief_walk start_walk(vec3 origin, vec3 direction, int level) {
    relief_walk walk;
    walk.size = relief_size();
    walk.last_level = int(relief.last_level);
    walk.largest = largest_height();
    walk.origin = origin;
    walk.direction = direction;
    walk.inverse = vec2(inverse_of(direction.x), inverse_of(direction.y));
    walk.quad = ivec2(floor(origin.xy));
    walk.tile = walk.quad - first_period(walk.quad);
    walk.level = level;
    walk.offset = int(relief.levels[level].offset);
    walk.place = 0.0;
    find_node(walk);
    return walk;
}

// Nodes of a level.
ivec2 nodes_of_level(relief_walk walk, int level) {
    return (walk.size + (1 << (2 * level)) - 1) >> (2 * level);
}

float node_maximum(relief_walk walk) {
    ivec2 node = (walk.first - walk.tile) >> (2 * walk.level);
    return maxima[walk.offset + node.y * nodes_of_level(walk, walk.level).x + node.x];
}

// To the node of the next finer level.
void descend(inout relief_walk walk) {
    --walk.level;
    ivec2 nodes = nodes_of_level(walk, walk.level);
    walk.offset -= nodes.x * nodes.y;
    find_node(walk);
}

// In the first period.
ivec2 local_quad(relief_walk walk) {
    return walk.quad - walk.tile;
}

// To the node behind the one that the walk leaves; a level up where that is also the end of the
// level's node.
void advance(inout relief_walk walk) {
    walk.place = walk.leave;
    vec2 at = walk.origin.xy + walk.place * walk.direction.xy;
    ivec2 inside = clamp(ivec2(floor(at)), walk.first, walk.last - 1);
    int shift = 2 * (walk.level + 1), side, size;
    if (walk.leaves_by_x) {
        bool forwards = !(walk.direction.x < 0.0);
        walk.quad = ivec2(forwards ? walk.last.x : walk.first.x - 1, inside.y);
        side = (forwards ? walk.last.x : walk.first.x) - walk.tile.x;
        size = walk.size.x;
    } else {
        bool forwards = !(walk.direction.y < 0.0);
        walk.quad = ivec2(inside.x, forwards ? walk.last.y : walk.first.y - 1);
        side = (forwards ? walk.last.y : walk.first.y) - walk.tile.y;
        size = walk.size.y;
    }
    bool ends = side == size || (side & ((1 << shift) - 1)) == 0;
    if (ends && walk.level < walk.last_level) {
        ivec2 nodes = nodes_of_level(walk, walk.level);
        walk.offset += nodes.x * nodes.y;
        ++walk.level;
    }
    find_node(walk);
}

// Where the walk through a quad crosses its diagonal, within the quad.
float crossing_of_diagonal(relief_walk walk) {
    vec2 origin = walk.origin.xy - vec2(walk.quad);
    float rate = walk.direction.x - walk.direction.y;
    float crossing = abs(rate) > 1e-12 ? (origin.y - origin.x) / rate : walk.leave;
    return clamp(crossing, walk.place, walk.leave);
}

// Whether a place of the walk is over the upper facet.
bool is_upper(relief_walk walk, float place) {
    vec2 at = walk.origin.xy - vec2(walk.quad) + place * walk.direction.xy;
    return at.x < at.y;
}

// ---------------------------------------------------------------------------------------------
// Where a ray meets the relief

struct relief_hit {
    bool found;
    vec3 position; // in the first period
    ivec2 quad;    // the same
    bool upper;
    vec3 normal;
};

// A node is passed once for each time that the walk meets it: a bound for rays that graze the tops.
const int WALK_STEPS = 2048;

// Meets a facet between two places from above, along a ray that sinks towards it: rays that start
// on a facet and rise above it do not meet it again, whatever the rounding.
bool meets_facet(relief_walk walk, vec4 corners, bool upper, float from, float to,
                 out float place) {
    vec2 slope = facet_slope(corners, upper);
    vec3 origin = walk.origin - vec3(walk.quad, corners.x);
    float rate = walk.direction.z - dot(slope, walk.direction.xy);
    float above = origin.z - dot(slope, origin.xy) + from * rate;
    place = from + max(above, 0.0) / max(-rate, 1e-30);
    return rate < 0.0 && above + (to - from) * rate < 0.0;
}

bool meets_quad(relief_walk walk, out float place, out bool upper) {
    vec4 corners = corner_heights(local_quad(walk), walk.size);
    float crossing = crossing_of_diagonal(walk);
    upper = is_upper(walk, 0.5 * (walk.place + crossing));
    if (meets_facet(walk, corners, upper, walk.place, crossing, place))
        return true;
    upper = is_upper(walk, 0.5 * (crossing + walk.leave));
    return meets_facet(walk, corners, upper, crossing, walk.leave, place);
}

relief_hit hit_at(relief_walk walk, float place, bool upper) {
    relief_hit hit;
    hit.found = true;
    hit.upper = upper;
    vec4 corners = corner_heights(local_quad(walk), walk.size);
    vec2 slope = facet_slope(corners, upper);
    vec2 inside = clamp(walk.origin.xy + place * walk.direction.xy - vec2(walk.quad), 0.0, 1.0);
    hit.quad = local_quad(walk);
    hit.position = vec3(vec2(hit.quad) + inside, corners.x + dot(slope, inside));
    hit.normal = facet_normal(slope);
    return hit;
}

// The level at which a ray from above begins: it meets the relief soon, and goes down a level in
// each step.
const int FIRST_LEVEL = 2;

bool may_meet_node(relief_walk walk) {
    float lowest = walk.origin.z +
                   walk.direction.z * (walk.direction.z < 0.0 ? walk.leave : walk.place);
    return lowest <= node_maximum(walk);
}

relief_hit trace_relief(vec3 origin, vec3 direction) {
    int level = origin.z > largest_height() ? min(FIRST_LEVEL, int(relief.last_level)) : 0;
    relief_walk walk = start_walk(origin, direction, level);
    relief_hit none;
    none.found = false;
    for (int i = 0; i < WALK_STEPS; ++i) {
        bool goes_down = walk.level > 0 && may_meet_node(walk);
        if (goes_down)
            descend(walk);
        float place;
        bool upper;
        if (walk.level == 0 && meets_quad(walk, place, upper))
            return hit_at(walk, place, upper);
        if (goes_down && walk.level > 0)
            continue;
        if (walk.direction.z >= 0.0 &&
            walk.origin.z + walk.leave * walk.direction.z >= walk.largest)
            return none;
        advance(walk);
    }
    return none;
}

bool sees_sky(vec3 origin, vec3 direction) {
    return direction.z > 0.0 && !trace_relief(origin, direction).found;
}

#endif
