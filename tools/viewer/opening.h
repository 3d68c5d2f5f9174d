#ifndef TOOLS_VIEWER_OPENING_H
#define TOOLS_VIEWER_OPENING_H

#include <lobe/result.h>

struct viewer;

/// A file's or a folder's own name: where it begins in a path. A name that is none: all of it.
const char *viewer_name_of(const char *path);

/// The scene that the command line asks for, with its camera and lights.
lobe_result viewer_open_first_scene(struct viewer *v);

/// Opens what was dropped or chosen since the last frame, which must have been finished; not before
/// a frame has said so. What cannot be opened leaves all as it was, and a line in the window.
/// Errors: only those after which nothing can be drawn.
lobe_result viewer_open_wanted(struct viewer *v);

#endif
