#version 460
#extension GL_GOOGLE_include_directive : require

// Gives each cell the T of its patch. A thread a cell.

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
    vec2 middle = (vec2(index % level.width, index / level.width) + 0.5) /
                  vec2(level.width, level.height);
    uvec2 place = min(uvec2(middle * float(wu.patches)), uvec2(wu.patches - 1u));
    uint patch_index = place.y * wu.patches + place.x;
    cells[level.first_cell + index].numerator = quotients[2u * patch_index];
    cells[level.first_cell + index].denominator =
        wu.printed != 0u ? mean_numerator() : quotients[2u * patch_index + 1u];
}
