#version 460
#extension GL_GOOGLE_include_directive : require

// Of some cells that are spread over the map, the light that a white relief reflects at once:
// C = mean a b b^T / pi in all polynomials, 16 x 16 numbers. A group a cell, a thread a quad.

#include "filters/displaced/facet_sky.glsl"

layout(local_size_x = TRANSFER_BASIS_POINTS, local_size_y = TRANSFER_BASIS_POINTS) in;

layout(set = 0, binding = 5, std430) writeonly buffer cell_block { vec4 cells[]; };

const uint FACETS = 2u * TRANSFER_BASIS_POINTS * TRANSFER_BASIS_POINTS;
const uint ROW_PARTS = 4u * TRANSFER_BASIS_TERMS;

shared float b[FACETS][TRANSFER_BASIS_TERMS]; // times the root of the facet's weight

void share(uint facet, float polynomials[16], float normal_z) {
    float weight = sqrt(INVERSE_PI / (float(FACETS) * normal_z));
    for (int k = 0; k < TRANSFER_BASIS_TERMS; ++k)
        b[facet][k] = weight * polynomials[k];
}

void main() {
    uvec2 size = uvec2(transfer.width, transfer.height);
    uvec2 first = gl_WorkGroupID.xy * size / gl_NumWorkGroups.xy;
    uvec2 inside = gl_LocalInvocationID.xy * (TRANSFER_BASIS_CELL / TRANSFER_BASIS_POINTS);
    uvec2 place = (first + inside) % size;
    uint quad = place.y * size.x + place.x;
    float lower[16], upper[16];
    see_sky(quad, lower, upper);
    share(2u * gl_LocalInvocationIndex, lower, facet_of(2u * quad).normal.z);
    share(2u * gl_LocalInvocationIndex + 1u, upper, facet_of(2u * quad + 1u).normal.z);
    barrier();
    uint part = gl_LocalInvocationIndex, row = part / 4u, column = 4u * (part % 4u);
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < FACETS; ++i)
        sum += b[i][row] *
               vec4(b[i][column], b[i][column + 1u], b[i][column + 2u], b[i][column + 3u]);
    uint cell = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    cells[cell * ROW_PARTS + part] = sum;
}
