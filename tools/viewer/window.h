#ifndef TOOLS_VIEWER_WINDOW_H
#define TOOLS_VIEWER_WINDOW_H

#include <lobe/result.h>

struct viewer;

/// Opens the window, with panels over it, whose mouse and keys move the viewer's camera.
/// LOBE_ERROR_UNSUPPORTED with a line: no display, no Vulkan.
lobe_result viewer_window_open(struct viewer *v);
void viewer_window_close(struct viewer *v);

#endif
