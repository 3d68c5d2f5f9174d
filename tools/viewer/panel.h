#ifndef TOOLS_VIEWER_PANEL_H
#define TOOLS_VIEWER_PANEL_H

struct viewer;

/// Declares what lies over the picture: the panel, the keys where they are asked for, the last
/// message. The user's changes take effect at once.
void viewer_panel(struct viewer *v);

#endif
