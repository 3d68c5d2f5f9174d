#ifndef PASSES_MAPS_COLOURS_MIRRORED_LUMINANCE_H
#define PASSES_MAPS_COLOURS_MIRRORED_LUMINANCE_H

#include "passes/upload/device_scene.h"

/// Whether texels of a material mirror more or less light than others, and maps of its lobes can
/// tell which: its colours lie on the surface as its lobes do. Such maps weight each texel by that
/// (shaders/maps/mirrored_luminance.glsl), and under a mask also by what that keeps.
bool passes_mirrored_luminance_varies(const device_material *material);

#endif
