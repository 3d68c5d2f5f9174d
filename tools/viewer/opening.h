#ifndef TOOLS_VIEWER_OPENING_H
#define TOOLS_VIEWER_OPENING_H

#include <lobe/result.h>

struct viewer;

/// Where the last component of a path begins. A path without one is returned unchanged.
const char *viewer_name_of(const char *path);

/// Opens the scene of the command line, with its camera and lights.
lobe_result viewer_open_first_scene(struct viewer *v);

/// Opens what was dropped or chosen since the last frame, which must have been finished; first lets
/// a frame show a message about it. If opening fails, nothing changes, and the window shows why.
/// Errors: only those after which nothing can be drawn.
lobe_result viewer_open_wanted(struct viewer *v);

#endif
