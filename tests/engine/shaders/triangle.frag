#version 460

layout(push_constant) uniform Push {
    vec4 offset;
    vec4 tint;
};

layout(set = 0, binding = 0, std430) readonly buffer Vertices {
    vec4 vertices[];
};
layout(set = 0, binding = 1) uniform sampler2D colours;
layout(set = 0, binding = 2) uniform sampler2D unused;

layout(location = 0) out vec4 colour;
layout(location = 2) out vec4 normal;

void main() {
    colour = tint * texture(colours, gl_FragCoord.xy) + vertices[0];
    normal = vec4(0, 0, 1, 0);
}
