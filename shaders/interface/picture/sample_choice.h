#ifndef INTERFACE_PICTURE_SAMPLE_CHOICE_H
#define INTERFACE_PICTURE_SAMPLE_CHOICE_H

#include "../types.h"

// What shading/samples/picture_key.comp sums over a tile, of KEY_TILE pixels a side.
#define KEY_TILE  64
#define KEY_GROUP 8 // invocations a side
struct key_sum {
    float roots;  // of the brightest channel of the radiance
    float pixels; // that have any light
    uint padding_0;
    uint padding_1;
};
INTERFACE_SIZE(key_sum, 16)
INTERFACE_OFFSET(key_sum, pixels, 4)

// Push constants of shading/samples/sample_choice.comp.
struct sample_choice_constants {
    uint most;         // samples of a pixel that needs more than one
    uint everywhere;   // bool: all pixels do
    float depth_scale; // see passes_camera_slope_scale
    float depth_offset;
    uint tiles;   // of struct key_sum
    uint blended; // bool: the picture will be blended over another
    uint padding_0;
    uint padding_1;
};
INTERFACE_SIZE(sample_choice_constants, 32)
INTERFACE_OFFSET(sample_choice_constants, everywhere, 4)
INTERFACE_OFFSET(sample_choice_constants, depth_scale, 8)
INTERFACE_OFFSET(sample_choice_constants, depth_offset, 12)
INTERFACE_OFFSET(sample_choice_constants, tiles, 16)
INTERFACE_OFFSET(sample_choice_constants, blended, 20)

// The pixels that take more than one sample (storage buffer): how many, then each once, in any
// order, y in the upper half of a word, x in the lower.
#define SAMPLE_LIST_FIRST 1

#endif
