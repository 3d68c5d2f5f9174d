#ifndef TOOLS_VIEWER_RECORDING_H
#define TOOLS_VIEWER_RECORDING_H

struct viewer;

/// Redraws the first side, as `lobe render` would, and writes it to the folder of recordings:
/// SCENE-NUMBER.exr, with the next free number. The frame in flight must have been finished.
/// Failures are shown in the window, and end the recording of a path.
void viewer_record(struct viewer *v);

#endif
