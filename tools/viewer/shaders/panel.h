#ifndef VIEWER_PANEL_H
#define VIEWER_PANEL_H

#include "../../../shaders/interface/types.h"

// Push constants of panel.vert and panel.frag.
struct panel_constants {
    float4 clip;       // left, top, right, bottom in pixels: clip rectangle
    float pixel_width; // in clip space
    float pixel_height;
    uint padding_0;
    uint padding_1;
};
INTERFACE_SIZE(panel_constants, 32)

#endif
