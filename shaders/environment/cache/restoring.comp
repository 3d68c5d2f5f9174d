#version 460
#extension GL_GOOGLE_include_directive : require

// One level of a cube from an image of its faces below one another.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D faces;
layout(set = 0, binding = 1) uniform writeonly image2DArray target;

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    int width = imageSize(target).x;
    if (any(greaterThanEqual(place, ivec3(width, width, 6))))
        return;
    imageStore(target, place, texelFetch(faces, ivec2(place.x, place.z * width + place.y), 0));
}
