#ifndef TOOLS_VIEWER_FRAME_H
#define TOOLS_VIEWER_FRAME_H

#include "tools/viewer/graphics/display.h"

/// A frame of the viewer: both sides, and the display.
#define VIEWER_COMMANDS 3

/// The commands of the one frame in flight. All zero: none.
typedef struct viewer_frame {
    VkCommandPool pool;
    VkCommandBuffer commands[VIEWER_COMMANDS];
    VkFence done;
    bool under_way;
} viewer_frame;

lobe_result viewer_frame_open(const viewer_device *device, viewer_frame *frame);
void viewer_frame_close(const viewer_device *device, viewer_frame *frame);

/// Waits until the device has finished the frame, and reads its times.
lobe_result viewer_frame_finish(const viewer_device *device, viewer_frame *frame,
                                viewer_side sides[2]);

/// Draws what is stale, and the window's current image, without waiting. The previous frame must
/// have been finished. A side that cannot be drawn is left out.
lobe_result viewer_frame_draw(const viewer_view *view, viewer_frame *frame, viewer_display *display,
                              const viewer_look *look, viewer_side sides[2],
                              const viewer_swapchain *swapchain);

#endif
