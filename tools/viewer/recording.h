#ifndef TOOLS_VIEWER_RECORDING_H
#define TOOLS_VIEWER_RECORDING_H

struct viewer;

/// Draws the first side again, as `lobe render` would, and writes it to the folder of recordings:
/// SCENE-NUMBER.exr, with a number above those there. The frame under way must have been finished.
/// Failures are told in the window, and end the recording of a path.
void viewer_record(struct viewer *v);

#endif
