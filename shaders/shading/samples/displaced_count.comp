#version 460
#extension GL_GOOGLE_include_directive : require

// How many indices a draw of displaced geometry has, which only the device knows: written into the
// arguments of a pass that takes further samples.

#include "interface/displacement/displacement.h"

layout(local_size_x = 1) in;

layout(push_constant) uniform constants_block { uint record; };
layout(set = 0, binding = 0, std430) readonly buffer displaced_argument_block {
    uint displaced_arguments[];
};
layout(set = 0, binding = 1, std430) buffer argument_block { uint arguments[]; };

void main() {
    arguments[5u * record] = displaced_arguments[PATCH_DRAW];
}
