#ifndef TOOLS_VIEWER_GRAPHICS_H
#define TOOLS_VIEWER_GRAPHICS_H

#include "tools/viewer/graphics/swapchain.h"

struct viewer;

/// All that the viewer has on the device. It can be closed and opened again: what is to be seen is
/// drawn anew.
lobe_result viewer_graphics_open(struct viewer *v);
/// All zero is fine.
void viewer_graphics_close(struct viewer *v);

/// Images of the window's size in the place of those before. Where it has none (it is minimised)
/// there is no swapchain, and it stays stale.
lobe_result viewer_graphics_resize(struct viewer *v);
/// Panels of the size that the window's content is scaled to.
lobe_result viewer_graphics_rescale(struct viewer *v);

/// What comes of showing: the swapchain, and the surface, may have to be made anew. `result` where
/// that is not the way out.
lobe_result viewer_graphics_handle_result(struct viewer *v, viewer_shown shown, lobe_result result);
/// Opens a lost device again. LOBE_ERROR_DEVICE_LOST after a line where it is lost again and again.
lobe_result viewer_graphics_recover(struct viewer *v);

#endif
