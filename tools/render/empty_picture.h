#ifndef TOOLS_RENDER_EMPTY_PICTURE_H
#define TOOLS_RENDER_EMPTY_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/image.h>
#include <lobe/scene.h>

/// Whether no pixel of a picture is covered: alpha is 0 everywhere.
bool empty_picture_recognise(const lobe_image *radiance);

/// Whether all radiance of a picture is 0, as it also is of an empty one.
bool empty_picture_is_black(const lobe_image *radiance);

/// Why the scene's own camera sees nothing, as a line for the user: "the camera looks away from the
/// scene, ..." `aspect`: width over height.
void empty_picture_explain(const lobe_scene *scene, double aspect, char *text, size_t size);

#endif
