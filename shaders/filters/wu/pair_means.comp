#version 460
#extension GL_GOOGLE_include_directive : require

// Means over the samples of each patch of products of what two directions send: the light that
// white diffuse facets send from one to the other, the same for both orders of the two, unless
// those differ (one_way). A thread for each sixteen pairs and patch: fewer reads.

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

void main() {
    uint row = filled_direction_count() / 4u;
    uint patch_index = gl_GlobalInvocationID.x / (row * row);
    uint block = gl_GlobalInvocationID.x % (row * row), i = block / row, j = block % row;
    bool one_way = stage.one_way != 0u;
    if (patch_index >= wu.patches * wu.patches || (j > i && !one_way))
        return;
    mat4 sum = mat4(0.0);
    uint place = patch_index * stage.samples * row;
    for (uint k = 0u; k < stage.samples; ++k) {
        // Columns: j; rows: i.
        sum += outerProduct(left[place + i], right[place + j]);
        if (!one_way)
            sum += outerProduct(right[place + i], left[place + j]);
        place += row;
    }
    sum *= (one_way ? 1.0 : 0.5) / (PI * float(stage.samples));
    // Of a block on the diagonal, each pair once.
    for (uint column = 0u; column < 4u; ++column)
        for (uint line = i == j && !one_way ? column : 0u; line < 4u; ++line)
            store(patch_index, 4u * i + line, 4u * j + column, sum[column][line]);
}
