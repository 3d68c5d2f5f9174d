#version 460
#extension GL_GOOGLE_include_directive : require

// Paths of light over the relief: from points that are stratified over each patch of the map, each
// in a direction drawn with the cosine to the facet, until they leave. A thread a path.

#include "filters/displaced/height_field.glsl"
#include "filters/wu/cells.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 4, std430) writeonly buffer vertex_block { path_point points[]; };

relief_hit facet_at(vec2 position) {
    relief_hit hit;
    hit.found = true;
    hit.quad = first_period(ivec2(floor(position)));
    vec2 inside = fract(position);
    hit.upper = inside.x < inside.y;
    vec4 corners = quad_heights(hit.quad);
    vec2 slope = facet_slope(corners, hit.upper);
    hit.position = vec3(vec2(hit.quad) + inside, corners.x + dot(slope, inside));
    hit.normal = facet_normal(slope);
    return hit;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= path_count())
        return;
    uint seed = hash(index);
    relief_hit hit = facet_at(path_start(index));
    for (uint k = 0u; k < wu.bounces; ++k) {
        uint place = index * wu.bounces + k;
        if (k > 0u) {
            float square = hashed_number(seed + 2u * k);
            float angle = 2.0 * PI * hashed_number(seed + 2u * k + 1u);
            vec3 local = vec3(sqrt(square) * vec2(cos(angle), sin(angle)), sqrt(1.0 - square));
            hit = trace_relief(hit.position, frame_of_axis(hit.normal) * local);
        }
        points[place] = path_point(vec4(hit.position, hit.found ? 1.0 : 0.0),
                                   vec4(hit.normal, 0.0));
        if (!hit.found)
            break;
    }
}
