#ifndef PASSES_UPLOAD_COLOURS_COLOUR_CORRELATION_H
#define PASSES_UPLOAD_COLOURS_COLOUR_CORRELATION_H

#include "passes/upload/device_scene.h"

/// Finds whether the diffuse colours of a material go with its normals somewhere on its maps, so
/// that the mean of their products is not the product of their means (material->colours). What was
/// found of `before` stays where its texels did. Maps that the host cannot read may.
void passes_colour_correlation_find(const device_scene *scene, const device_material *before,
                                    device_material *material);

#endif
