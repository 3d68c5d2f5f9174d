#ifndef PASSES_DISPLACEMENT_DRAWN_BOUNDS_H
#define PASSES_DISPLACEMENT_DRAWN_BOUNDS_H

#include "passes/upload/device_scene.h"

/// Bounds of what a frame draws, in the world: those of the scene, and how far displaced surfaces
/// can be from them.
void passes_drawn_bounds(const device_scene *scene, float minimum[3], float maximum[3]);

#endif
