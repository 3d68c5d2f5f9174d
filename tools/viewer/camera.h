#ifndef TOOLS_VIEWER_CAMERA_H
#define TOOLS_VIEWER_CAMERA_H

#include <lobe/scene.h>

/// Interactive camera movements. The up vector stays upright: the eye turns around it, and never
/// looks along it.

/// Turns the eye around the target: to the right, and upwards; radians.
void viewer_camera_orbit(lobe_camera *camera, double right, double up);
/// Turns the view around the eye: to the right, and upwards; radians.
void viewer_camera_look(lobe_camera *camera, double right, double up);
/// Moves eye and target across the view: to the right, and upwards; as fractions of the picture's
/// height at the target.
void viewer_camera_pan(lobe_camera *camera, double right, double up);
/// Moves eye and target: to the right, upwards, forwards; as fractions of the distance between
/// them.
void viewer_camera_fly(lobe_camera *camera, const double steps[3]);
/// Multiplies the distance between eye and target by a factor above 0.
void viewer_camera_zoom(lobe_camera *camera, double factor);

#endif
