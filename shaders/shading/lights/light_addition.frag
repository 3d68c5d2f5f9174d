#version 460

// Adds the light of further passes (passes/renderer/light_parts.h) to the picture.

layout(set = 0, binding = 0) uniform sampler2D sum;

layout(location = 0) out vec4 radiance_out;

void main() {
    radiance_out = vec4(texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb, 0.0);
}
