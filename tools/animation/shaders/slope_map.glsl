// Normal maps as slopes of a height field, in the units of the height: along u to the right, along
// v downwards. RGB = (n + 1) / 2 with +Y upwards.

layout(set = 0, binding = 0) uniform sampler2D base;
layout(set = 0, binding = 1, rgba8) writeonly uniform image2D texels;

layout(push_constant) uniform constants_block {
    float time; // seconds
};

vec2 slope_of_texel(vec3 texel) {
    vec3 normal = 2.0 * texel - 1.0;
    return vec2(-normal.x, normal.y) / max(normal.z, 0.05);
}

vec4 texel_of_slope(vec2 slope) {
    return vec4(0.5 + 0.5 * normalize(vec3(-slope.x, slope.y, 1.0)), 1.0);
}
