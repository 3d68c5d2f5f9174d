#ifndef PASSES_UPLOAD_COLOURS_MASK_ALPHA_H
#define PASSES_UPLOAD_COLOURS_MASK_ALPHA_H

#include "passes/upload/device_scene.h"

/// The factor of a map's alpha that a mask compares with its cutoff: that of the base colour, times
/// that of vertices. Where these differ, it is the middle of those with which anything can be kept.
float passes_mask_alpha(const device_scene *scene, const device_material *material);

#endif
