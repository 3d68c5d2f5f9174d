#version 460

// One texel of each face.

layout(local_size_x = 1) in;

layout(set = 0, binding = 0) uniform samplerCube cube;
layout(set = 0, binding = 1) writeonly buffer face_block { float faces[]; };

void main() {
    uint face = gl_GlobalInvocationID.x;
    vec3 direction = vec3(0.0);
    direction[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
    if (face < 6)
        faces[face] = textureLod(cube, direction, 0.0).x;
}
