#version 460
#extension GL_GOOGLE_include_directive : require

// One level of a tile of a map from an image in which all levels' texels follow each other, row by
// row.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D stored_map;
layout(set = 0, binding = 16) uniform writeonly image2DArray target_map;

layout(push_constant) uniform constants_block {
    uvec2 size;   // of the tile's level
    ivec2 origin; // in the map
    uint first;   // texel of the level, of those of all levels and layers
};

void main() {
    uvec3 position = gl_GlobalInvocationID;
    if (any(greaterThanEqual(position.xy, size)))
        return;
    uint row = uint(textureSize(stored_map, 0).x);
    uint texel = first + (position.z * size.y + position.y) * size.x + position.x;
    imageStore(target_map, ivec3(origin + ivec2(position.xy), position.z),
               texelFetch(stored_map, ivec2(texel % row, texel / row), 0));
}
