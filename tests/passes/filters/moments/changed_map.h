#ifndef TESTS_PASSES_FILTERS_MOMENTS_CHANGED_MAP_H
#define TESTS_PASSES_FILTERS_MOMENTS_CHANGED_MAP_H

#include "tests/passes/support/pass_run.h"

/// Maps of normals (RGBA32_FLOAT) of several kinds; `amount`: the slope.
typedef lobe_image (*make_normals)(uint32_t width, uint32_t height, double amount);

lobe_image round_bumps(uint32_t width, uint32_t height, double amount);
/// Along one axis.
lobe_image grooves_along_x(uint32_t width, uint32_t height, double amount);
/// That lean to three sides.
lobe_image three_facets(uint32_t width, uint32_t height, double amount);
/// All texels lean alike.
lobe_image one_slope(uint32_t width, uint32_t height, double amount);
/// One texel among flat ones.
lobe_image one_deviating(uint32_t width, uint32_t height, double amount);
/// Low bumps; `amount`: the part of the texels that are steep.
lobe_image cracked_bumps(uint32_t width, uint32_t height, double amount);
lobe_image noisy_normals(uint32_t width, uint32_t height, double amount);

/// Replaces the texels of a scene's image by those of another of its size, which it frees.
void replace_texels(lobe_scene *scene, uint32_t index, lobe_image other);

/// Copies what the frame's graph read back from a buffer.
void copy_read_back(const fixture *f, lobe_resource buffer, void *data, size_t size);

#endif
