#ifndef PASSES_MAPS_MATERIAL_PATCH_H
#define PASSES_MAPS_MATERIAL_PATCH_H

#include "passes/maps/colours/lobe_mask.h"
#include "passes/upload/colours/material_colours.h"
#include "passes/upload/material_lobes.h"

/// The lobes of a small square of a material's maps, as a pixel's footprint may contain them.
/// Filters try several precisions on a few patches and compare the errors. More patches or
/// directions than these do not change the choice.
enum { MATERIAL_PATCHES = 12, MATERIAL_PATCH_EXTENT = 24, MATERIAL_PATCH_DIRECTIONS = 48 };

typedef struct material_patch {
    /// Weights add up to one. Where maps of lobes count texels by what they mirror, so do these,
    /// but without the factor of the base colour.
    material_lobe
        lobes[MATERIAL_PATCH_EXTENT * MATERIAL_PATCH_EXTENT * LOBE_MATERIAL_MAXIMUM_LOBES];
    /// One for each lobe, which are microfacets then.
    material_colours colours[MATERIAL_PATCH_EXTENT * MATERIAL_PATCH_EXTENT];
    size_t count;     ///< 0: a mask cuts all away
    bool has_colours; ///< lobes count by what they mirror, and the host reads their colours
} material_patch;

/// What a mask keeps of patch `index` of MATERIAL_PATCHES. False if a map of lobes has a format
/// that the host does not read.
bool passes_material_patch_read(const device_scene *scene, const device_material *material,
                                const lobe_mask *mask, uint32_t index, material_patch *patch);

#endif
