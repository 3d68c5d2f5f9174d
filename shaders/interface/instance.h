#ifndef INTERFACE_INSTANCE_H
#define INTERFACE_INSTANCE_H

#include "types.h"

// An affine object-to-world transform.
struct instance_constants {
    float4 rows[3]; // each: three of the linear part, then the translation
};
INTERFACE_SIZE(instance_constants, 48)

// Push constants of a draw of instances.
struct draw_constants {
    uint first_instance; // index of its transform; those of the others follow
    float map_width;     // of the height map, the object's lengths, if slopes follow its stretching
    uint number;         // of the batch, from 1 on, in the picture of surfaces
};
INTERFACE_SIZE(draw_constants, 12)
INTERFACE_OFFSET(draw_constants, map_width, 4)
INTERFACE_OFFSET(draw_constants, number, 8)

// Push constants of culling: what lies behind one of four planes is not seen.
struct culling_constants {
    float4 planes[4];  // normals inwards, of any length, and offsets, in the world
    uint first_record; // of the arguments of draws
    uint padding_0;
    uint padding_1;
    uint padding_2;
};
INTERFACE_SIZE(culling_constants, 80)
INTERFACE_OFFSET(culling_constants, first_record, 64)

// Instances that are drawn together, for culling.
struct culled_batch {
    float4 minimum; // of the mesh, in the object; w is not used
    float4 maximum;
    uint first; // of the transforms
    uint count;
    uint index_count; // of an instance
    uint padding;
};
INTERFACE_SIZE(culled_batch, 48)
INTERFACE_OFFSET(culled_batch, maximum, 16)
INTERFACE_OFFSET(culled_batch, first, 32)
INTERFACE_OFFSET(culled_batch, count, 36)
INTERFACE_OFFSET(culled_batch, index_count, 40)

#define CULLING_THREADS 64 // of a batch

#endif
