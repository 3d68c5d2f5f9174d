#version 460
#extension GL_GOOGLE_include_directive : require

// Gives each cell the T of the patches around it, or of all patches that it covers. A
// thread a cell.

#define CELL_ACCESS
#include "filters/wu/cells.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform step_block { wu_step stage; };
layout(set = 0, binding = 8, std430) readonly buffer patch_block { vec4 quotients[]; };

// Printed: divided by the mean over the map, so that the mean of T is 1.
vec4 mean_numerator() {
    vec4 sum = vec4(0.0);
    uint count = wu.patches * wu.patches;
    for (uint i = 0u; i < count; ++i)
        sum += quotients[2u * i];
    return sum / float(count);
}

void main() {
    wu_level level = wu.levels[stage.level];
    uint index = gl_GlobalInvocationID.x;
    if (index >= level.width * level.height)
        return;
    vec4 mean = mean_numerator();
    patch_range range = patches_of_cell(stage.level, level.first_cell + index);
    vec4 numerator = vec4(0.0), denominator = vec4(0.0);
    for (int y = range.first.y; y <= range.last.y; ++y)
        for (int x = range.first.x; x <= range.last.x; ++x) {
            uint place = 2u * patch_index(ivec2(x, y));
            float weight = patch_weight(range, ivec2(x, y));
            numerator += weight * quotients[place];
            denominator += weight * (is_printed(WU_PRINTED_RATIO) ? mean : quotients[place + 1u]);
        }
    cells[level.first_cell + index].numerator = numerator;
    cells[level.first_cell + index].denominator = denominator;
}
