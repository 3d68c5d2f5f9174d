#version 460
#extension GL_GOOGLE_include_directive : require

// One binding of each kind, to test reflection.

layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;

layout(constant_id = 3) const uint repetitions = 1;
layout(constant_id = 7) const bool doubled = false;

layout(push_constant) uniform Push {
    vec4 scale;
    uint offset;
} push;

layout(set = 0, binding = 0, std140) uniform Camera {
    mat4 projection;
    vec4 eye;
} camera;

layout(set = 0, binding = 1) readonly buffer Source {
    uvec4 header;
    float source[];
};

layout(set = 0, binding = 2) writeonly buffer Target {
    float target[];
};

layout(set = 0, binding = 3) buffer Counter {
    uint counter;
};

layout(set = 0, binding = 4) uniform sampler2D plane;
layout(set = 0, binding = 5) uniform sampler2DArray layered;
layout(set = 0, binding = 6) uniform samplerCube sky;
layout(set = 0, binding = 7) uniform sampler2DMS multisampled;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D written;
layout(set = 0, binding = 8, r32f) uniform readonly image2DArray stored;
layout(set = 0, binding = 10, rgba8) uniform image2D modified;
layout(set = 0, binding = 11) uniform sampler2D unused;
layout(set = 0, binding = 12) uniform sampler2D several[3];

void main() {
    vec4 sum = camera.projection * camera.eye * push.scale;
    for (uint i = 0; i < repetitions; i++)
        sum += textureLod(plane, vec2(0), 0) + textureLod(layered, vec3(0), 0) +
               textureLod(sky, vec3(1), 0) + texelFetch(multisampled, ivec2(0), 0) +
               imageLoad(stored, ivec3(0)) + textureLod(several[2], vec2(0), 0);
    if (doubled)
        sum *= 2;
    sum += imageLoad(modified, ivec2(0));
    imageStore(modified, ivec2(0), sum);
    imageStore(written, ivec2(0), sum);
    target[push.offset] = source[header.x] + sum.x;
    counter += 1;
}
