#ifndef PASSES_MAPS_MATERIAL_PATCH_H
#define PASSES_MAPS_MATERIAL_PATCH_H

#include "passes/maps/colours/lobe_mask.h"
#include "passes/upload/material_lobes.h"

/// The lobes of a small square of a material's maps, as a pixel's footprint may contain them.
/// Filters try several precisions on a few patches and compare the errors. More patches or
/// directions than these do not change the choice.
enum { MATERIAL_PATCHES = 12, MATERIAL_PATCH_EXTENT = 24, MATERIAL_PATCH_DIRECTIONS = 48 };

typedef struct material_patch {
    material_lobe lobes[MATERIAL_PATCH_EXTENT * MATERIAL_PATCH_EXTENT *
                        LOBE_MATERIAL_MAXIMUM_LOBES]; ///< weights add up to one
    size_t count;                                     ///< 0: a mask cuts all away
} material_patch;

/// What a mask keeps of patch `index` of MATERIAL_PATCHES. False if a map has a format that the
/// host does not read.
bool passes_material_patch_read(const device_material *material, const lobe_mask *mask,
                                uint32_t index, material_patch *patch);

/// The sum of all lobes at a unit direction.
double passes_material_patch_evaluate(const material_patch *patch, const double direction[3]);
/// The same for some of its lobes.
double passes_material_lobes_evaluate(const material_lobe *lobes, size_t count,
                                      const double direction[3]);

/// Direction `index` of MATERIAL_PATCH_DIRECTIONS, drawn from one of the patch's lobes: the mean of
/// error over truth at such directions is the error's integral.
void passes_material_patch_draw(const material_patch *patch, uint32_t index, double direction[3]);

#endif
