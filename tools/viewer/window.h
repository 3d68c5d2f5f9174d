#ifndef TOOLS_VIEWER_WINDOW_H
#define TOOLS_VIEWER_WINDOW_H

#include <stdbool.h>

#include <lobe/result.h>

struct viewer;

/// Opens the window, with panels over it; mouse and keys move the viewer's camera.
/// LOBE_ERROR_UNSUPPORTED, with a message: no display, no Vulkan.
lobe_result viewer_window_open(struct viewer *v);
void viewer_window_close(struct viewer *v);

/// Whether the mouse can grab the divider of a split view.
bool viewer_window_is_on_divider(const struct viewer *v);

#endif
