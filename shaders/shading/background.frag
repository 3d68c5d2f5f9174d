#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants AOV

// Draws the environment where no surface covers it.

#include "interface/background.h"
#include "lib/light/environment_level.glsl"

layout(push_constant) uniform background_block { background_constants background; };
layout(set = 0, binding = 0) uniform samplerCube environment_cube;

layout(location = 0) in vec2 clip_position;
layout(location = 0) out vec4 radiance_out;
#ifdef AOV
layout(location = 1) out vec4 normal_depth_out;
layout(location = 2) out vec2 lobes_level_out;
#endif

void main() {
    vec3 direction = background.centre.xyz + clip_position.x * background.right.xyz +
                     clip_position.y * background.down.xyz;
    float level = 0.0;
    if (background.right.w > 0.0)
        level = solid_angle_level(float(textureSize(environment_cube, 0).x), background.right.w);
    radiance_out =
        vec4(background.centre.w * textureLod(environment_cube, direction, level).rgb, 0.0);
#ifdef AOV
    normal_depth_out = vec4(0.0);
    lobes_level_out = vec2(0.0);
#endif
}
