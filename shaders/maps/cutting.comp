#version 460
#extension GL_GOOGLE_include_directive : require

// A tile of a map's first level as an image of its own.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray source_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray tile_map;

layout(push_constant) uniform constants_block {
    ivec2 origin; // in the map
};

void main() {
    ivec3 position = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(position, imageSize(tile_map))))
        return;
    imageStore(tile_map, position, texelFetch(source_map, position + ivec3(origin, 0), 0));
}
