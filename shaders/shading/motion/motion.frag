#version 460
#extension GL_GOOGLE_include_directive : require

// The motion of a surface. Clip coordinates before the division are linear over a triangle.

#include "interface/motion.h"
#include "shading/motion/motion.glsl"

layout(location = 0) in vec3 current;
layout(location = 1) in vec3 change;
layout(location = 0) out vec2 motion_out;

void main() {
    motion_out = motion_of(current, change);
}
