#ifndef TOOLS_VIEWER_GRAPHICS_H
#define TOOLS_VIEWER_GRAPHICS_H

#include "tools/viewer/graphics/swapchain.h"

struct viewer;

/// All objects of the viewer on the device. It can be closed and opened again: everything is then
/// redrawn.
lobe_result viewer_graphics_open(struct viewer *v);
/// All zero is allowed.
void viewer_graphics_close(struct viewer *v);

/// Recreates the images in the window's size. While it has none (it is minimised) there is no
/// swapchain, and it stays stale.
lobe_result viewer_graphics_resize(struct viewer *v);
/// Scales the panels like the window's content.
lobe_result viewer_graphics_rescale(struct viewer *v);

/// Handles the result of showing a frame: recreates the swapchain, and the surface, if necessary.
/// Otherwise returns `result`.
lobe_result viewer_graphics_handle_result(struct viewer *v, viewer_shown shown, lobe_result result);
/// Reopens a lost device. LOBE_ERROR_DEVICE_LOST, with a message, if it is lost repeatedly.
lobe_result viewer_graphics_recover(struct viewer *v);

#endif
