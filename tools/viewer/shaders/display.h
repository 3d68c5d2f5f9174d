#ifndef VIEWER_DISPLAY_H
#define VIEWER_DISPLAY_H

#include "../../../shaders/interface/types.h"

// What a picture's numbers mean.
#define DISPLAY_RADIANCE 0u // linear; tone-mapped
#define DISPLAY_COLOUR   1u // linear, in [0, 1]
#define DISPLAY_COUNT    2u // numbers from 0 on; a heat map

// How two pictures are shown.
#define DISPLAY_SINGLE 0u
#define DISPLAY_SPLIT  1u // the first to the left of the divider, the second to the right
#define DISPLAY_ERROR  2u // heat map of the first's difference from the second

// Push constants of display.frag.
struct display_constants {
    uint comparison;
    uint first_kind;
    uint second_kind;
    float first_maximum; // of counts
    float second_maximum;
    float divider;       // pixels from the left
    float gain;          // of radiance
    float error_maximum; // relative error shown brightest
};
INTERFACE_SIZE(display_constants, 32)

#endif
