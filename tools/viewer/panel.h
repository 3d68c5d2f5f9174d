#ifndef TOOLS_VIEWER_PANEL_H
#define TOOLS_VIEWER_PANEL_H

struct viewer;

/// Declares what is shown over the picture: the panel, the keys if requested, the last message. The
/// user's changes take effect at once.
void viewer_panel(struct viewer *v);

#endif
