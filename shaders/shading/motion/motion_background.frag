#version 460
#extension GL_GOOGLE_include_directive : require

// The motion of what is infinitely far away, which a camera's turn alone moves.

#include "interface/motion.h"
#include "shading/motion/motion.glsl"

layout(push_constant) uniform background_block { motion_background_constants background; };

layout(location = 0) in vec2 clip_position;
layout(location = 0) out vec2 motion_out;

void main() {
    vec4 direction = vec4(background.centre.xyz + clip_position.x * background.right.xyz +
                              clip_position.y * background.down.xyz,
                          0.0);
    vec3 current = (motion.current * direction).xyw;
    vec3 change = (motion.change * direction).xyw;
    // An orthographic camera has no place for it.
    motion_out = current.z > 0.0 ? motion_of(current, change) : vec2(0.0);
}
