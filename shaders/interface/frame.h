#ifndef INTERFACE_FRAME_H
#define INTERFACE_FRAME_H

#include "types.h"

// Constants that all draws of a frame share (uniform block, std140).
struct frame_constants {
    float4x4 world_to_clip;   // reversed depth; clip space as in lobe/graph.h
    float4x4 world_to_camera; // rotation only: x right, y up, z towards the viewer
    float4 eye;               // world position; w = 1. Orthographic: direction to the viewer, w = 0
    float4 axis;              // unit view direction; w: its product with the eye's position
    uint directional_count;   // lights are sorted: directional, point, spot
    uint point_count;
    uint spot_count;
    float footprint;      // side of the square that a sample stands for, pixels
    float dither;         // [0, 1): added to the thresholds of masks, another one for each sample
    uint first_light;     // of this pass
    float vertex_spacing; // asked for, of displaced geometry, pixels
    uint seed;            // of random numbers, another one for each sample
};
INTERFACE_SIZE(frame_constants, 192)
INTERFACE_OFFSET(frame_constants, world_to_camera, 64)
INTERFACE_OFFSET(frame_constants, eye, 128)
INTERFACE_OFFSET(frame_constants, axis, 144)
INTERFACE_OFFSET(frame_constants, directional_count, 160)
INTERFACE_OFFSET(frame_constants, point_count, 164)
INTERFACE_OFFSET(frame_constants, spot_count, 168)
INTERFACE_OFFSET(frame_constants, footprint, 172)
INTERFACE_OFFSET(frame_constants, dither, 176)
INTERFACE_OFFSET(frame_constants, first_light, 180)
INTERFACE_OFFSET(frame_constants, vertex_spacing, 184)
INTERFACE_OFFSET(frame_constants, seed, 188)

#endif
