#ifndef TOOLS_VIEWER_GRAPHICS_DISPLAY_H
#define TOOLS_VIEWER_GRAPHICS_DISPLAY_H

#include "tools/viewer/graphics/swapchain.h"
#include "tools/viewer/side.h"

/// How two sides are shown.
typedef enum viewer_comparison {
    VIEWER_SINGLE, ///< only the first
    VIEWER_SPLIT,  ///< the first to the left of a divider, the second to the right
    VIEWER_ERROR,  ///< a heat map of the error of the first relative to the second
} viewer_comparison;

/// Largest exposure in stops, up and down.
#define VIEWER_MAXIMUM_EXPOSURE 10.0

typedef struct viewer_look {
    viewer_comparison comparison;
    double exposure;      ///< stops
    double divider;       ///< part of the window's width
    double error_maximum; ///< relative error shown brightest
} viewer_look;

/// Turns pictures into the window's content, and draws the panels over it: passes of the viewer on
/// a graph of lobe. All zero: none.
typedef struct viewer_display {
    lobe_graph *graph;
    lobe_texture *font, *blank;
} viewer_display;

/// Panels must be open (third_party/imgui.h).
lobe_result viewer_display_open(const viewer_device *device, viewer_display *display);
void viewer_display_close(viewer_display *display);

/// Call when the panels' font has changed. No recorded frame may be in flight.
lobe_result viewer_display_renew_font(const viewer_device *device, viewer_display *display);

/// Records drawing the swapchain's current image, with the panels of this frame.
lobe_result viewer_display_record(viewer_display *display, const viewer_look *look,
                                  const viewer_side sides[2], const viewer_swapchain *swapchain,
                                  VkCommandBuffer commands);

#endif
