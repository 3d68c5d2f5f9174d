#version 460
#extension GL_GOOGLE_include_directive : require

// Means over the samples of each patch of products of what two directions send: the light that
// white diffuse facets send from one to the other, the same for both orders of the two, unless
// those differ (one_way). A thread for each 64 pairs and patch: fewer reads.

#include "filters/wu/cells.glsl"
#include "filters/wu/paths.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 4, std430) readonly buffer left_block { vec4 left[]; };
layout(set = 0, binding = 5, std430) readonly buffer right_block { vec4 right[]; };
layout(set = 0, binding = 6, std430) writeonly buffer pair_block { float pairs[]; };

void store(uint patch_index, uint i, uint j, float value) {
    uint directions = direction_count();
    if (i >= directions || j >= directions)
        return;
    uint first = patch_index * directions * directions;
    pairs[first + i * directions + j] = value;
    if (stage.one_way == 0u)
        pairs[first + j * directions + i] = value;
}

// Of eight rows and eight columns of pairs: by four rows, and then by four columns.
struct pair_sums {
    mat4 parts[2][2];
};

void add_products(inout pair_sums sums, vec4 rows[2], vec4 columns[2]) {
    for (uint a = 0u; a < 2u; ++a)
        for (uint b = 0u; b < 2u; ++b)
            sums.parts[a][b] += outerProduct(rows[a], columns[b]);
}

void main() {
    uint row = filled_direction_count() / 8u;
    uint patch_index = gl_GlobalInvocationID.x / (row * row);
    uint block = gl_GlobalInvocationID.x % (row * row), i = block / row, j = block % row;
    bool one_way = stage.one_way != 0u, one_order = one_way || stage.alike != 0u;
    if (patch_index >= wu.patches * wu.patches || (j > i && !one_way))
        return;
    pair_sums sums;
    for (uint part = 0u; part < 4u; ++part)
        sums.parts[part / 2u][part % 2u] = mat4(0.0);
    uint first = patch_index * stage.samples * 2u * row;
    for (uint k = 0u; k < stage.samples; ++k) {
        uint rows = first + 2u * (k * row + i), columns = first + 2u * (k * row + j);
        add_products(sums, vec4[](left[rows], left[rows + 1u]),
                     vec4[](right[columns], right[columns + 1u]));
    }
    for (uint k = 0u; k < (one_order ? 0u : stage.samples); ++k) {
        uint rows = first + 2u * (k * row + i), columns = first + 2u * (k * row + j);
        add_products(sums, vec4[](right[rows], right[rows + 1u]),
                     vec4[](left[columns], left[columns + 1u]));
    }
    float scale = (one_order ? 1.0 : 0.5) / (PI * float(stage.samples));
    // Of a block on the diagonal, each pair once.
    for (uint column = 0u; column < 8u; ++column)
        for (uint line = i == j && !one_way ? column : 0u; line < 8u; ++line)
            store(patch_index, 8u * i + line, 8u * j + column,
                  scale * sums.parts[line / 4u][column / 4u][column % 4u][line % 4u]);
}
