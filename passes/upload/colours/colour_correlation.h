#ifndef PASSES_UPLOAD_COLOURS_COLOUR_CORRELATION_H
#define PASSES_UPLOAD_COLOURS_COLOUR_CORRELATION_H

#include "passes/upload/device_scene.h"

/// Whether the diffuse colours of a material go with its normals somewhere on its maps, so that the
/// mean of their products is not the product of their means. Maps that the host cannot read may.
/// Reads texels when a filter first asks, and again when the maps, their texels, or the
/// material's steepness or metal have changed.
bool passes_colours_follow_normals(const device_scene *scene, device_material *material);

#endif
