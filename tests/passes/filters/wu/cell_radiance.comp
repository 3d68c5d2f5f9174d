#version 460
#extension GL_GOOGLE_include_directive : require

// What a filter of reliefs shows of each cell, from each direction under light from each.

#define LOBE_SET           1
#define LOBE_CONSTANT_BASE 7

#ifdef FILTER_WU
#include "lobe/wu.glsl"
#else
#include "lobe/displaced.glsl"
#endif

layout(local_size_x = 64) in;

const uint DIRECTIONS = 48u;

layout(set = 0, binding = 0, std430) buffer cell_block_of_host {
    vec4 directions[DIRECTIONS]; // in the tangent frame
    uvec4 cells;                 // along the map's axes, and texels of the map
    float radiance[];            // by cell, light and viewer
} data;

void main() {
    uint cell = gl_GlobalInvocationID.x / DIRECTIONS, viewer = gl_GlobalInvocationID.x % DIRECTIONS;
    if (cell >= data.cells.x * data.cells.y)
        return;
    // Cells begin at the centres of texels.
    vec2 size = vec2(data.cells.zw), counts = vec2(data.cells.xy);
    vec2 uv = (vec2(cell % data.cells.x, cell / data.cells.x) + 0.5) / counts + 0.5 / size;
    lobe_surface surface =
        lobe_surface_at(mat3(1.0), data.directions[viewer].xyz, uv, vec2(1.0 / counts.x, 0.0),
                        vec2(0.0, 1.0 / counts.y));
    lobe_appearance fetched = lobe_fetch(surface);
    for (uint light = 0u; light < DIRECTIONS; light += 4u) {
        vec3 towards[4];
        for (uint k = 0u; k < 4u; ++k)
            towards[k] = data.directions[light + k].xyz;
        lobe_gather(fetched, surface, towards);
        for (uint k = 0u; k < 4u; ++k)
            data.radiance[(cell * DIRECTIONS + light + k) * DIRECTIONS + viewer] =
                lobe_evaluate_gathered(fetched, surface, towards[k], k).g;
    }
}
